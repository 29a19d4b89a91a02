"""Where the last crop of a lane stands: weeds, thin stands, ragged ends, rows alone, all crops."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.estimation.lane_end import LaneEnd
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, names_of

CROPS = pytest.mark.parametrize("name", tuple(names_of(Kind.CROP)))


@CROPS
def test_a_lane_of_any_crop_has_no_end_inside_and_one_where_it_ends(name: str, ends: SimpleNamespace) -> None:
    crop = load_crop(name)

    judged = ends.drive(LaneEnd(crop, -1.0, None), ends.lane(crop, 10.0), 11.5)

    assert all(view.probability < 0.8 for at_m, view in judged if at_m + ends.far_m < 10.0)
    assert judged[-1][1].probability > ends.sure
    assert judged[-1][1].crop_until_m == pytest.approx(10.0, abs=0.06)


def test_a_lone_large_weed_beyond_the_end_does_not_move_it(ends: SimpleNamespace) -> None:
    plants = np.append(ends.lane(ends.beet, 6.0), 7.3)

    judged = ends.drive(LaneEnd(ends.beet, -1.0, None), plants, 7.5)

    assert judged[-1][1].crop_until_m == pytest.approx(6.0, abs=0.06)
    assert judged[-1][1].probability > ends.sure


def test_small_weeds_strewn_in_line_beyond_the_end_do_not_move_it(ends: SimpleNamespace) -> None:
    plants = ends.lane(ends.beet, 6.0)
    weeds = 6.6 + np.arange(8) * 0.3
    weight = np.concatenate([np.ones(len(plants)), np.full(len(weeds), 0.15)])

    judged = ends.drive(LaneEnd(ends.beet, -1.0, None), np.concatenate([plants, weeds]), 7.5, weight)

    assert judged[-1][1].crop_until_m == pytest.approx(6.0, abs=0.06)


def test_a_small_weed_just_past_the_last_plants_is_none_of_them(ends: SimpleNamespace) -> None:
    plants = ends.lane(ends.beet, 6.0)
    weight = np.append(np.ones(len(plants)), 0.15)

    judged = ends.drive(LaneEnd(ends.beet, -1.0, None), np.append(plants, 6.3), 7.5, weight)

    assert judged[-1][1].crop_until_m == pytest.approx(6.0, abs=0.06)


@CROPS
def test_a_thin_stand_has_no_end_inside(name: str, ends: SimpleNamespace) -> None:
    crop = load_crop(name)

    for seed in range(2):
        judged = ends.drive(LaneEnd(crop, -1.0, None), ends.lane(crop, 20.0, seed, keep=0.6), 18.0)
        assert all(view.probability < ends.sure for _, view in judged), f"seed {seed}"


@pytest.mark.parametrize("ends_m", [(5.7, 6.0, 6.3), (6.3, 5.7, 5.8), (5.9, 5.7, 6.3), (6.0, 6.3, 6.3)])
def test_a_ragged_end_is_where_the_longest_row_ends(ends_m: tuple[float, ...], ends: SimpleNamespace) -> None:
    judged = ends.drive(LaneEnd(ends.beet, -1.0, None), np.concatenate(ends.rows(ends.beet, ends_m)), 7.5)

    assert judged[-1][1].crop_until_m == pytest.approx(6.3, abs=0.06)
    assert judged[-1][1].probability > ends.sure


@pytest.mark.parametrize("gone_to_m", [2.0, 7.0])
def test_one_row_alone_carries_the_lane_on(gone_to_m: float, ends: SimpleNamespace) -> None:
    first, second, third = ends.rows(ends.beet, [10.0] * 3)
    plants = np.concatenate([first, ends.outside(second, 2.0, gone_to_m), ends.outside(third, 2.0, 7.0)])

    judged = ends.drive(LaneEnd(ends.beet, -1.0, None), plants, 8.0)

    assert all(view.probability < 0.8 for _, view in judged)


def test_crop_that_the_trailing_camera_alone_sees_is_crop(ends: SimpleNamespace) -> None:
    end = LaneEnd(ends.beet, -1.0, None)
    ends.drive(end, ends.lane(ends.beet, 6.0), 6.5)
    late = np.arange(6.1, 6.6, 0.1)

    end.trail(late, np.ones(len(late)), (5.5, 7.0))

    assert end.judge().crop_until_m == pytest.approx(6.5, abs=0.06)


def test_before_any_crop_was_seen_nothing_has_ended(ends: SimpleNamespace) -> None:
    judged = ends.drive(LaneEnd(ends.beet, -1.0, None), np.empty(0), 3.0)

    assert all(view.probability < 0.5 and view.empty_m == 0.0 for _, view in judged)
