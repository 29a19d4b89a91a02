"""Following a lane by sight: onto it, along it, over gaps, and to its end."""

from math import radians
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import Direction
from fieldnav.perception.canopy import canopy_plane
from fieldnav.settings.crop import ControlLaw
from states.names import Event

LAWS = pytest.mark.parametrize("law", ControlLaw, ids=lambda law: law.value)
DIRECTIONS = pytest.mark.parametrize("direction", Direction, ids=lambda direction: direction.value)


@LAWS
@DIRECTIONS
def test_the_robot_comes_onto_the_lane_and_stays_on_it(
    law: ControlLaw, direction: Direction, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3), direction, left_m=0.08, turned_deg=4.0)
    aside = []

    step = robot.drive("tracking", 7.0, lambda _: aside.append((robot.s_m, robot.left_m)))

    s_m, left_m = np.array(aside).T
    turned = robot.true.heading_rad - (0 if direction is Direction.FORWARD else np.pi)
    assert step.event is None and robot.s_m >= 7.0
    assert np.abs(left_m[s_m > 4.0]).max() < 0.02
    assert abs(turned) < radians(1.5)
    assert direction.sign * step.motion.twist.vx_mps == crop.speeds.follow_mps


def test_a_side_slope_leaves_no_offset_with_the_lanes_path(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (16.0,) * 3))
    robot.sideslip = 0.02
    aside = []

    robot.drive("tracking", 12.0, lambda _: aside.append((robot.s_m, robot.left_m)))

    s_m, left_m = np.array(aside).T
    assert abs(left_m[s_m > 6.0].mean()) < 0.008


@LAWS
@DIRECTIONS
def test_the_lane_ends_soon_after_its_last_plants_have_come_into_view(
    law: ControlLaw, direction: Direction, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (5.0,) * 3), direction)

    step = robot.follow(to_m=5.09)

    ended = [each for _, _, each in robot.passed if each.event is Event.LANE_ENDED]
    first_m = next(s_m for s_m, _, each in robot.passed if each.event is Event.LANE_ENDED)
    assert step.event is None and len(ended) == 1
    _, far_m = canopy_plane(drawn.camera, crop).view_m
    assert 0.3 < first_m + far_m - 5.0 < crop.row_end.longest_gap_m
    assert first_m < 5.0 + crop.switching.headland_m + drawn.camera.forward_m, "before the place to stop"


def test_where_gaps_are_short_the_lane_ends_without_coasting(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING, longest_gap_m=0.8)
    robot = drawn.robot(crop, drawn.lane(crop, (4.0,) * 3))

    step = robot.drive("tracking", 5.0)

    assert step.event is Event.LANE_ENDED
    assert robot.s_m < 3.5


@LAWS
@pytest.mark.parametrize("gap_m", [1.0, 2.0])
def test_a_gap_in_all_rows_never_makes_the_robot_leave_the_lane(
    law: ControlLaw, gap_m: float, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (14.0,) * 3, ((4.0, 4.0 + gap_m),)))
    aside = []

    step = robot.follow(to_m=9.0, watch=lambda _: aside.append(robot.left_m))

    assert step.event is None
    assert robot.went_through()[-1] == "tracking"
    assert np.abs(aside).max() < 0.04


def test_rows_of_which_most_are_gone_are_lost_after_a_bounded_distance(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0, 4.0, 4.0)))

    step = robot.drive("tracking", 8.0)

    assert step.event is Event.ROWS_LOST
    assert 3.0 < robot.s_m < 4.0


def test_one_row_of_three_gone_is_no_loss(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (14.0, 14.0, 4.0)))
    aside = []

    step = robot.drive("tracking", 9.0, lambda _: aside.append(robot.left_m))

    assert step.event is None
    assert np.abs(aside[-60:]).max() < 0.025


def test_between_frames_the_motion_follows_the_dead_reckoning(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3))
    robot.drive("tracking", 3.0)
    tracking = drawn.states["tracking"](robot.task, robot.direction, robot.memory)
    robot.ticks -= robot.ticks % drawn.frame_ticks
    with_frame = tracking.step(robot.seen(tracking.cameras))

    turned = robot.reckoned
    robot.reckoned = type(turned)(turned.x_m, turned.y_m + 0.03, turned.heading_rad + 0.1)
    robot.ticks += 1
    between = tracking.step(robot.seen(tracking.cameras))

    assert between.evidence == () and between.event is None and between.sight is None
    changed = [
        getattr(between.motion.twist, name) - getattr(with_frame.motion.twist, name)
        for name in ("vx_mps", "vy_mps", "yaw_rate_rps")
    ]
    control, speed_mps = crop.control, crop.speeds.follow_mps
    assert changed[0] == 0.0
    assert changed[1] == pytest.approx(-speed_mps * (0.03 / control.offset_length_m + 0.1), abs=0.003)
    assert changed[2] == pytest.approx(-speed_mps * 0.1 / control.heading_length_m, abs=0.003)
