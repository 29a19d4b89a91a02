"""Rows followed while the robot steps sideways: by sight, by its wheels, and by both."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import CameraName
from fieldnav.odometry import Pose
from fieldnav.perception.sidestep.following import follow
from fieldnav.perception.sidestep.lane_odds import Expected
from fieldnav.perception.sidestep.meeting import all_known
from fieldnav.perception.sidestep.next_lane import next_lane
from fieldnav.perception.sidestep.passing_rows import Crossing, PassingRow
from fieldnav.perception.sidestep.row_words import MOST_BY_FEATURES, words
from fieldnav.perception.sidestep.wheel_motion import Travelled, travelled
from fieldnav.settings.crop import CropProfile

UNKNOWN = Expected(None, 0.1, 2.5)


@pytest.fixture
def crop(drawn: SimpleNamespace) -> CropProfile:
    made: CropProfile = drawn.beet
    return made


def certain(crossing: Crossing, crop: CropProfile) -> list[float]:
    """Where the certain new rows are, from the inside outward."""
    return sorted(crossing.rows[row].across_m for row in crossing.new if words(crossing, row, crop).certain)


def test_rows_not_seen_for_a_long_way_are_carried_along_by_the_wheels(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    walk = stepping.Walk(
        crop, drawn.camera, stepping.lanes(crop, (0, 1, 2)), wheels=1.03, hidden_m=(0.3, 0.9)
    )

    crossing = walk.end(stepping.pitch_m)
    lane = next_lane(crossing, UNKNOWN, crop)

    assert lane and lane.rows_seen == 3 and lane.middle_m == pytest.approx(0.0, abs=0.03)
    assert lane.pitch_m == pytest.approx(stepping.pitch_m, abs=0.1)


def test_what_was_carried_unseen_is_known_less_surely(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    field = stepping.lanes(crop, (0, 1))
    seen, unseen = (
        stepping.Walk(crop, drawn.camera, field, hidden_m=hidden).end(0.4) for hidden in ((0, 0), (0.1, 0.5))
    )

    assert np.sqrt(unseen.covariance[0, 0]) > 1.2 * np.sqrt(seen.covariance[0, 0])


def test_standing_still_makes_no_new_rows(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 1)))
    there = walk.end(0.8)

    after = [crossing for _, crossing in walk.steps([0.8] * 60, there)]

    assert len(certain(there, crop)) > 0
    assert {len(certain(crossing, crop)) for crossing in after} == {len(certain(there, crop))}


def test_going_back_and_forth_counts_nothing_twice(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 1)))
    ways = [np.arange(0, 0.9, 0.01), np.arange(0.9, 0.5, -0.01), np.arange(0.5, 1.5, 0.01)]

    *_, (_, last) = walk.steps(np.concatenate(ways))

    assert len(certain(last, crop)) == crop.rows.per_lane


def test_after_a_return_only_the_old_lane_is_known_and_the_next_is_found_again(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 1, 2)))
    *_, (_, back) = walk.steps(np.arange(1.5, 0.6, -0.01), walk.end(1.5))

    again = walk.end(1.5, 0.61, all_known(back))

    assert not all_known(back).new
    lane = next_lane(again, UNKNOWN, crop)
    assert lane and lane.rows_seen == 3 and lane.middle_m == pytest.approx(0.0, abs=0.03)


def test_a_wrong_word_of_the_features_only_delays_a_row(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    field = stepping.lanes(crop, (0, 1))

    def says(word: float) -> float:
        def told(crossing: Crossing) -> Crossing:
            rows = (row if row.of_old_lane else replace(row, features=word) for row in crossing.rows)
            return replace(crossing, rows=tuple(rows))

        walk = stepping.Walk(crop, drawn.camera, field, change=told)
        return next(way for way, each in walk.steps(np.arange(0, 1.2, 0.01)) if certain(each, crop))

    right_m, none_m, wrong_m = says(MOST_BY_FEATURES), says(0.0), says(-MOST_BY_FEATURES)

    assert right_m < none_m < wrong_m < right_m + 0.12


def test_a_single_look_makes_no_row(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0,)))
    flash = np.array([[x, 1.0] for x in np.arange(1.1, 1.9, 0.2)])
    *_, (_, crossing) = walk.steps(np.arange(0, 0.31, 0.01))

    seen = stepping.centres(np.concatenate([walk.plants_m, flash]), 0.31, crop, drawn.camera)
    crossing = follow(crossing, seen, Travelled(0.0, 0.01, 0.0), crop, drawn.camera)

    assert not certain(crossing, crop)
    *_, (_, after) = walk.steps(np.arange(0.31, 0.5, 0.01), crossing)
    assert not after.new, "it is forgotten once its place is seen empty"


def test_a_turn_that_the_wheels_report_turns_the_rows(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    start = stepping.begun(crop, drawn.camera)
    nothing = stepping.centres(np.empty((0, 2)), 0.0, crop, drawn.camera)

    turned = follow(start, nothing, Travelled(0.0, 0.0, 0.02), crop, drawn.camera)

    assert turned.slope == pytest.approx(start.slope - 0.02)
    assert all(
        after.across_m < before.across_m for before, after in zip(start.rows, turned.rows, strict=True)
    )


def test_the_motion_is_told_in_the_axes_of_the_camera() -> None:
    before, after = Pose(1.0, 2.0, np.pi / 2), Pose(0.9, 2.05, np.pi / 2 + 0.01)

    front, rear = (travelled(before, after, camera) for camera in (CameraName.FRONT, CameraName.REAR))

    assert (front.ahead_m, front.left_m, front.turn_rad) == pytest.approx((0.05, 0.1, 0.01))
    assert (rear.ahead_m, rear.left_m, rear.turn_rad) == pytest.approx((-0.05, -0.1, 0.01))


def test_a_row_s_end_is_remembered_where_its_nearest_plant_stood(
    drawn: SimpleNamespace, stepping: SimpleNamespace, crop: CropProfile
) -> None:
    crossing = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 1))).end(0.1)
    nothing = stepping.centres(np.empty((0, 2)), 0.0, crop, drawn.camera)

    nearer = follow(crossing, nothing, Travelled(0.2, 0.0, 0.0), crop, drawn.camera)

    ends = [row.end_m for row in crossing.rows if row.of_old_lane]
    assert all(1.1 < end < 1.5 for end in ends)
    assert [row.end_m for row in nearer.rows if row.of_old_lane] == pytest.approx([end - 0.2 for end in ends])
    assert PassingRow(0.0).end_m == np.inf
