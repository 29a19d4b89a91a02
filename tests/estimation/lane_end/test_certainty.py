"""How sure the end of a lane is: by what was seen empty, the longest gap, and the lanes before."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.estimation.lane_end import ENDS_PER_M, GAPS_PER_M, RARE, LaneEnd


@pytest.mark.parametrize("longest_gap_m", [1.0, 4.0])
def test_an_end_is_sure_after_a_distance_that_follows_from_the_longest_gap(
    longest_gap_m: float, ends: SimpleNamespace
) -> None:
    shipped_m = ends.beet.row_end.longest_gap_m

    needed = ends.needed_m(ends.with_gap(ends.beet, longest_gap_m))

    assert needed == pytest.approx(ends.needed_m(ends.beet) * longest_gap_m / shipped_m, abs=3 * ends.frame_m)
    assert 0.7 * longest_gap_m < needed < 1.1 * longest_gap_m


def test_the_shipped_profile_is_not_sure_of_an_end_before_two_metres_and_is_at_the_place_to_stop(
    ends: SimpleNamespace,
) -> None:
    camera_m, headland_m = 0.75, ends.beet.switching.headland_m

    assert 1.9 < ends.needed_m(ends.beet) < headland_m + camera_m + ends.far_m


def test_the_probability_grows_with_the_gap_seen_so_far_as_bayes_says(ends: SimpleNamespace) -> None:
    judged = ends.drive(LaneEnd(ends.beet, -1.0, None), ends.lane(ends.beet, 6.0), 8.0)

    past = [view for _, view in judged if view.seen_until_m > 6.5]
    probabilities = [view.probability for view in past]
    none_m, longest_m = (min(judged, key=lambda each: abs(each[1].empty_m - m))[1] for m in (0.0, 2.5))
    rare = ENDS_PER_M / (ENDS_PER_M + RARE * GAPS_PER_M)
    assert none_m.probability < ENDS_PER_M / (ENDS_PER_M + GAPS_PER_M) + 0.01
    assert longest_m.empty_m == pytest.approx(ends.beet.row_end.longest_gap_m, abs=ends.frame_m)
    assert longest_m.probability == pytest.approx(rare, abs=0.01)
    assert (np.diff(probabilities) >= 0).all()
    assert all(view.empty_m == pytest.approx(view.seen_until_m - 6.0, abs=0.06) for view in past)


@pytest.mark.parametrize("seed", range(3))
def test_a_gap_in_all_rows_up_to_that_distance_is_never_the_end(seed: int, ends: SimpleNamespace) -> None:
    gap_m = (6.0, 6.0 + ends.needed_m(ends.beet) - 2 * ends.frame_m)
    plants = ends.outside(ends.lane(ends.beet, 14.0, seed), *gap_m)

    judged = ends.drive(LaneEnd(ends.beet, -1.0, None), plants, 12.0)

    assert all(view.probability < ends.sure for _, view in judged)
    assert max(view.empty_m for _, view in judged) > 1.7


def test_where_the_lanes_before_were_longer_a_gap_of_two_metres_is_never_sure(ends: SimpleNamespace) -> None:
    plants = ends.outside(ends.lane(ends.beet, 14.0), 6.0, 8.0)

    judged = ends.drive(LaneEnd(ends.beet, -1.0, 14.0), plants, 12.0)

    assert max(view.empty_m for _, view in judged) == pytest.approx(2.0, abs=0.2)
    assert all(view.probability < ends.sure for _, view in judged)


def test_a_lane_far_shorter_than_those_before_is_less_believed_and_one_as_long_more(
    ends: SimpleNamespace,
) -> None:
    views = {
        expected_m: ends.drive(LaneEnd(ends.beet, -1.0, expected_m), ends.lane(ends.beet, 8.0), 8.5)[-1][1]
        for expected_m in (None, 8.0 - ends.far_m, 20.0)
    }

    unknown, as_before, shorter = (views[each].probability for each in (None, 8.0 - ends.far_m, 20.0))
    assert shorter < unknown < as_before
    assert as_before > ends.sure > shorter


def test_the_length_is_from_where_crop_was_first_judged_and_so_is_that_of_the_next_lane(
    ends: SimpleNamespace,
) -> None:
    forward, backward = LaneEnd(ends.beet, -1.0, None), LaneEnd(ends.beet, -16.0, None)
    ends.drive(forward, ends.lane(ends.beet, 12.0), 13.0)
    ends.drive(backward, ends.lane(ends.beet, 12.0) - 15.0, -2.0, from_m=-15.0)

    assert forward.length_m() == pytest.approx(12.0 - ends.far_m, abs=0.25)
    assert backward.length_m() == pytest.approx(forward.length_m(), abs=0.25)


@pytest.mark.parametrize("longest_gap_m", [8.0, 10.0])
def test_a_gap_as_long_as_what_is_remembered_does_not_make_the_end_forgotten(
    longest_gap_m: float, ends: SimpleNamespace
) -> None:
    crop = ends.with_gap(ends.beet, longest_gap_m)

    judged = ends.drive(LaneEnd(crop, -1.0, 30.0), ends.lane(crop, 6.0), 20.0)

    beyond = [view for at_m, view in judged if at_m + ends.near_m > 6.0]
    assert len(beyond) > 200
    assert [view.crop_until_m for view in beyond] == pytest.approx([6.0] * len(beyond), abs=0.06)
    assert beyond[-1].probability > ends.sure
