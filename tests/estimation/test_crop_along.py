"""The strip of crop along a lane: what stands where, by the mean over all looks, within bounded memory."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fieldnav.estimation.crop_along import BIN_M, KEPT_M, CropAlong

VIEW = (0.8, 1.8)


def held_at(along: CropAlong, s_m: float) -> float:
    """What the bin about s holds."""
    far_edge, held, _ = along.strip()
    return float(held[np.abs(far_edge - BIN_M / 2 - s_m) < BIN_M / 2 + 1e-9][0])


def test_a_plant_lies_in_the_bin_where_it_stands() -> None:
    along = CropAlong(0.0)

    along.add(np.array([1.02, 1.52]), np.array([1.0, 0.5]), VIEW)

    s_m, held, seen = along.strip()
    assert s_m[held > 0] == pytest.approx([1.05, 1.55])
    assert held[held > 0] == pytest.approx([1.0, 0.5])
    assert s_m[seen][[0, -1]] == pytest.approx([VIEW[0] + BIN_M, VIEW[1]])


def test_what_a_bin_holds_is_the_mean_over_the_frames_that_had_it_in_view() -> None:
    along = CropAlong(0.0)

    along.add(np.array([1.02]), np.array([1.0]), VIEW)
    along.add(np.empty(0), np.empty(0), VIEW)
    along.add(np.empty(0), np.empty(0), (1.2, 2.2))

    assert held_at(along, 1.02) == pytest.approx(0.5)


def test_plants_beyond_the_view_and_behind_the_strip_are_left_out() -> None:
    along = CropAlong(1.0)

    along.add(np.array([0.5, 0.9, 1.1, 1.9]), np.ones(4), VIEW)

    s_m, held, _ = along.strip()
    assert s_m[held > 0] == pytest.approx([1.15], abs=BIN_M / 2 + 1e-9)


def test_a_view_behind_all_that_is_kept_changes_nothing() -> None:
    along = CropAlong(2.0)

    along.add(np.array([1.0]), np.ones(1), VIEW)

    assert not along.strip()[2].any()


def test_what_grows_between_the_rows_counts_against() -> None:
    along = CropAlong(0.0)

    along.add(np.array([1.02, 1.03]), np.array([0.4, -1.0]), VIEW)

    assert held_at(along, 1.02) == pytest.approx(-0.6)


def test_over_300_metres_the_strip_stays_as_short_and_in_step_with_the_robot() -> None:
    along = CropAlong(-1.0)
    before = [len(each) for each in along.strip()]
    for at_m in np.arange(0.0, 300.0, 0.1):
        plants = np.arange(np.ceil((at_m + VIEW[0]) / 0.2) * 0.2, at_m + VIEW[1], 0.2) + 0.001
        along.add(plants, np.ones(len(plants)), (at_m + VIEW[0], at_m + VIEW[1]))

    s_m, held, seen = along.strip()

    assert [len(each) for each in (s_m, held, seen)] == before
    assert s_m[-1] == pytest.approx(299.9 + VIEW[1], abs=BIN_M)
    assert s_m[0] == pytest.approx(s_m[-1] - KEPT_M + BIN_M)
    full = held > 0.5
    assert np.diff(s_m[full]) == pytest.approx(0.2, abs=BIN_M / 100)
    assert full.sum() == pytest.approx(KEPT_M / 0.2, abs=5)


@given(st.floats(0, 40))
def test_a_robot_that_leaps_ahead_keeps_what_still_lies_in_the_strip(leap_m: float) -> None:
    assume(abs(leap_m - 0.725) > 1e-6)  # where the plant's bin just leaves the view
    along = CropAlong(0.0)
    along.add(np.array([1.51]), np.ones(1), VIEW)

    along.add(np.empty(0), np.empty(0), (VIEW[0] + leap_m, VIEW[1] + leap_m))

    s_m, held, seen = along.strip()
    looks = 2 if leap_m < 0.725 else 1
    assert held.sum() == pytest.approx(1 / looks if s_m[0] < 1.56 else 0.0)
    assert s_m[seen][-1] == pytest.approx(VIEW[1] + leap_m, abs=BIN_M)
