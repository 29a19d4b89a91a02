"""Leaving a lane: to just past its last plants, back again if it was a gap, stopped if it is never sure."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import Direction, Twist
from fieldnav.settings.crop import ControlLaw
from states.exiting import BEYOND_M
from states.names import Event

LAWS = pytest.mark.parametrize("law", ControlLaw, ids=lambda law: law.value)
DIRECTIONS = pytest.mark.parametrize("direction", Direction, ids=lambda direction: direction.value)
NEAR_PLACE_M = 0.08


def evidence(step: SimpleNamespace, name: str) -> float:
    (found,) = [each.value for each in step.evidence if each.name == name]
    return found


@LAWS
@DIRECTIONS
def test_the_trailing_camera_comes_to_stand_just_past_the_last_plants(
    law: ControlLaw, direction: Direction, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (5.0,) * 3), direction)

    step = robot.follow(to_m=9.0)

    assert step.event is Event.LANE_LEFT and step.motion.twist == Twist()
    assert robot.went_through()[-1] == "exiting"
    past_m = robot.trailing_camera_m - 5.0
    assert past_m == pytest.approx(crop.switching.headland_m, abs=NEAR_PLACE_M)
    assert abs(robot.left_m) < 0.03
    assert evidence(step, "to the place to stop") <= 0
    assert robot.memory.trailing and len(robot.memory.trailing.rows) == crop.rows.per_lane


@LAWS
@pytest.mark.parametrize("ends_m", [(4.7, 5.0, 5.3), (5.3, 4.7, 4.8)])
def test_of_a_ragged_end_the_longest_row_is_left_behind(
    law: ControlLaw, ends_m: tuple[float, ...], drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, ends_m))

    step = robot.follow(to_m=9.0)

    assert step.event is Event.LANE_LEFT
    past_m = robot.trailing_camera_m - 5.3
    assert past_m == pytest.approx(crop.switching.headland_m, abs=NEAR_PLACE_M)


@pytest.mark.parametrize("name", ["winter-wheat", "potato", "coriander"])
def test_closed_rows_and_wide_plants_are_left_behind_as_well(name: str, drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING, name)
    robot = drawn.robot(crop, drawn.lane(crop, (5.0,) * crop.rows.per_lane))

    step = robot.follow(to_m=9.0)

    assert step.event is Event.LANE_LEFT
    assert robot.trailing_camera_m - 5.0 == pytest.approx(crop.switching.headland_m, abs=0.15)
    assert abs(robot.left_m) < 0.03


def test_the_last_lane_is_left_for_good(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (4.0,) * 3), number=2)

    assert robot.follow(to_m=8.0).event is Event.LAST_LANE_LEFT


@LAWS
@DIRECTIONS
def test_crop_that_comes_again_is_followed_to_its_true_end(
    law: ControlLaw, direction: Direction, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (8.0,) * 3, ((4.0, 5.9),)), direction)
    aside = []

    step = robot.follow(to_m=12.0, watch=lambda _: aside.append(robot.left_m))

    again = [(s_m, each) for s_m, _, each in robot.passed if each.event is Event.ROWS_SEEN_AGAIN]
    went = robot.went_through()
    assert len(again) == 1 and 4.0 < again[0][0] < 5.9
    assert again[0][1].reason == "crop comes again: it was a gap"
    assert went[went.index("exiting") :] in (
        ["exiting", "coasting", "tracking", "exiting"],
        ["exiting", "coasting", "tracking", "coasting", "exiting"],
    )
    assert step.event is Event.LANE_LEFT
    assert robot.trailing_camera_m - 8.0 == pytest.approx(crop.switching.headland_m, abs=0.12)
    assert np.abs(aside).max() < 0.04


@LAWS
def test_a_robot_that_is_never_sure_of_the_end_stops_and_says_so(
    law: ControlLaw, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law, longest_gap_m=5.0)
    robot = drawn.robot(crop, drawn.lane(crop, (4.0,) * 3))

    step = robot.follow(to_m=12.0)

    assert robot.went_through()[-1] == "exiting"
    assert step.event is Event.FAIL
    assert step.reason == "no crop either way, and yet the lane should not end here"
    assert step.motion.twist == Twist()
    past_m = robot.trailing_camera_m - 4.0 - crop.switching.headland_m
    assert past_m == pytest.approx(BEYOND_M, abs=2 * NEAR_PLACE_M)


def test_a_lane_as_long_as_those_before_is_left_as_soon_as_its_place_to_stop_is_reached(
    drawn: SimpleNamespace,
) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING, longest_gap_m=4.0)
    first = drawn.robot(drawn.profile(ControlLaw.PATH_FOLLOWING), drawn.lane(crop, (5.0,) * 3))
    first.follow(to_m=9.0)
    expected_m = first.memory.end.length_m()
    robot = drawn.robot(crop, drawn.lane(crop, (5.0,) * 3), Direction.BACKWARD, expected_m=expected_m)

    step = robot.follow(to_m=9.0)

    assert step.event is Event.LANE_LEFT
    assert robot.trailing_camera_m - 5.0 == pytest.approx(crop.switching.headland_m, abs=NEAR_PLACE_M)
    assert robot.memory.after().expected_m == pytest.approx(expected_m, abs=0.2)


def test_the_robot_slows_down_towards_the_place_to_stop(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (4.0,) * 3))
    robot.drive("tracking", 6.0)
    speeds = []

    robot.drive("exiting", 9.0, lambda step: speeds.append(step.motion.twist.vx_mps))

    assert speeds[0] == pytest.approx(crop.speeds.exit_mps)
    assert speeds[-2] < 0.12 and speeds[-1] == 0.0
    assert np.diff(speeds[:-1]).max() < 0.05
