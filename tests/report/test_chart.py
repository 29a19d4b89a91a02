"""A chart's axes bear round figures, and thinning a curve out loses nothing that shows."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.report.chart import chart_of
from fieldnav.report.curves import Curve, Panel, joined
from fieldnav.report.scale import clock_steps, round_steps, thinned
from fieldnav.report.shapes import Drawn

MOST = 20
spans = st.tuples(st.floats(-1e4, 1e4), st.floats(1e-2, 1e4))


@given(spans, st.integers(3, 8))
def test_steps_lie_within_the_range_and_are_few(span: tuple[float, float], most: int) -> None:
    low, high = span[0], span[0] + span[1]

    steps = round_steps(low, high, most)

    assert 1 <= len(steps) <= most + 1
    slack = 1e-6 * max(abs(low), abs(high))
    assert all(low - slack <= step <= high + slack for step in steps)


def test_steps_are_figures_that_people_count_in() -> None:
    assert round_steps(-2.2, 2.2, 4) == [-2.0, 0.0, 2.0]
    assert round_steps(0.0, 0.53, 4) == [0.0, 0.2, 0.4]
    assert clock_steps(0.0, 135.0, 12) == [15.0 * index for index in range(10)]


@given(st.lists(st.floats(-10, 10) | st.just(float("nan")), min_size=1, max_size=400))
def test_thinning_keeps_the_extremes_and_the_gaps(values: list[float]) -> None:
    array, time_s = np.array(values), np.arange(len(values), dtype=float)

    kept = thinned(time_s, array, MOST)

    assert len(kept) <= 3 * MOST or len(kept) == len(array)
    assert np.all(np.diff(kept) > 0)
    known = array[np.isfinite(array)]
    if len(known):
        assert np.nanmax(array[kept]) == known.max()
        assert np.nanmin(array[kept]) == known.min()
    assert np.isnan(array[kept]).any() == np.isnan(array).any()


def test_values_that_lie_far_apart_are_not_joined() -> None:
    times, values = joined(np.array([0.0, 0.2, 0.4, 5.0, 5.2]), np.array([1.0, np.nan, 2.0, 3.0, 4.0]))

    assert times.tolist() == [0.0, 0.4, 0.4, 5.0, 5.2]
    np.testing.assert_array_equal(values, [1.0, 2.0, np.nan, 3.0, 4.0])


def drawn(curve: Curve) -> Drawn:
    return chart_of([Panel("a panel", (curve,))], (), (), 10.0).panels[0].curves[0]


def test_a_gap_lifts_the_pen() -> None:
    curve = Curve("a curve", "#000", np.arange(5.0), np.array([1.0, 2.0, np.nan, 3.0, 4.0]))

    assert drawn(curve).path.count("M") == 2
    assert drawn(curve).path.count("L") == 2


def test_single_values_are_dots() -> None:
    curve = Curve("a curve", "#000", np.array([2.0, 4.0]), np.array([1.0, 3.0]), dotted=True)

    assert len(drawn(curve).dots) == 2
    assert not drawn(curve).path


def test_more_lies_higher_and_later_lies_farther_right() -> None:
    (first, second) = drawn(Curve("a curve", "#000", np.array([2.0, 4.0]), np.array([1.0, 3.0]), True)).dots

    assert second[0] > first[0]
    assert second[1] < first[1]
