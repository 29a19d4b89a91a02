"""A row end needs time and distance; a lane needs several looks that agree."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.perception.lane import LaneFit
from states.agreement import OFFSET_M, SLOPE, Agreement
from states.emptiness import Emptiness

CONFIRM_S, CONFIRM_M = 0.4, 0.15


def fit(offset_m: float = 0.0, slope: float = 0.0) -> LaneFit:
    return LaneFit((), offset_m, slope, 3, 0.35, 0.0)


@pytest.mark.parametrize("speed_mps", [0.0, 0.2, 2.0])
def test_an_end_needs_both_its_time_and_its_distance(speed_mps: float) -> None:
    empty = Emptiness(CONFIRM_S, CONFIRM_M)

    ended = {tick: empty.add(0, tick * 0.05, tick * 0.05 * speed_mps) for tick in range(100)}

    for tick, word in ended.items():
        enough = tick * 0.05 >= CONFIRM_S - 1e-9 and tick * 0.05 * speed_mps >= CONFIRM_M - 1e-9
        assert word == enough, f"after {tick * 0.05:.2f} s"


def test_driving_backward_is_distance_too() -> None:
    empty = Emptiness(CONFIRM_S, CONFIRM_M)

    assert not empty.add(0, 0.0, 5.0)
    assert empty.add(0, 1.0, 5.0 - CONFIRM_M)


@given(centres=st.lists(st.integers(0, 2), max_size=60))
def test_one_crop_centre_begins_the_wait_anew(centres: list[int]) -> None:
    empty = Emptiness(CONFIRM_S, CONFIRM_M)
    bare_ticks = 0
    for tick, count in enumerate(centres):
        ended = empty.add(count, tick * 0.1, tick * 0.1)
        bare_ticks = 0 if count else bare_ticks + 1
        # The first bare frame begins the wait; four more intervals of 0.1 s fill it.
        assert ended == (bare_ticks > 4) or abs((bare_ticks - 1) * 0.1 - CONFIRM_S) < 1e-6


def test_the_evidence_says_how_far_the_wait_has_come() -> None:
    empty = Emptiness(CONFIRM_S, CONFIRM_M)
    empty.add(0, 1.0, 2.0)
    empty.add(0, 1.25, 2.5)

    time, distance = empty.evidence("top half")

    assert (time.value, time.threshold, time.unit) == (pytest.approx(0.25), CONFIRM_S, "s")
    assert (distance.value, distance.threshold, distance.unit) == (pytest.approx(0.5), CONFIRM_M, "m")


def test_looks_that_agree_are_counted_and_then_believed() -> None:
    agreement = Agreement(3)

    words = [agreement.add(fit(offset_m=0.01 * look)) for look in range(5)]

    assert words == [False, False, True, True, True]
    assert agreement.evidence()[0].value == 5


@pytest.mark.parametrize("other", [None, fit(offset_m=OFFSET_M * 1.1), fit(slope=-SLOPE * 1.1)])
def test_a_look_that_disagrees_begins_anew(other: LaneFit | None, drawn: SimpleNamespace) -> None:
    agreement = Agreement(3)
    agreement.add(fit())
    agreement.add(fit())

    assert not agreement.add(other)
    assert not agreement.add(fit())
    assert agreement.looks == 1
