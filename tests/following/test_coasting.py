"""Coasting over lost rows: found again, found afresh, or stopped with the reason."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import Twist
from fieldnav.settings.crop import ControlLaw
from states.names import Event

LAWS = pytest.mark.parametrize("law", ControlLaw, ids=lambda law: law.value)
LONG_GAPS_M = 8.0


def evidence(step: SimpleNamespace, name: str) -> tuple[float, float]:
    (found,) = [(each.value, each.threshold) for each in step.evidence if each.name == name]
    return found


@LAWS
def test_rows_that_come_again_where_they_must_be_are_found_within_a_few_frames(
    law: ControlLaw, drawn: SimpleNamespace
) -> None:
    robot = drawn.robot(drawn.profile(law), drawn.lane(drawn.profile(law), (8.0,) * 3))

    step = robot.drive("coasting", 3.0)

    assert step.event is Event.ROWS_FOUND
    assert len(robot.passed) == 3
    assert evidence(step, "frames that show the rows again") == (3, 3)


@LAWS
def test_a_lane_that_comes_again_elsewhere_is_found_afresh(law: ControlLaw, drawn: SimpleNamespace) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3))
    robot.drive("tracking", 2.0)
    robot.plants_m = robot.plants_m + np.array([0.0, 0.15])

    step = robot.drive("coasting", 4.0)
    robot.drive("tracking", 7.0)

    assert step.event is Event.ROWS_FOUND
    assert robot.left_m == pytest.approx(0.15, abs=0.02)


@LAWS
def test_rows_lost_for_longer_than_the_longest_gap_stop_the_robot(
    law: ControlLaw, drawn: SimpleNamespace
) -> None:
    """One row of three carries the lane on, so that it has not ended, but is too few to follow."""
    crop = drawn.profile(law, longest_gap_m=1.5)
    robot = drawn.robot(crop, drawn.lane(crop, (14.0, 3.0, 3.0)))

    step = robot.follow(to_m=9.0)

    entered_m = next(s_m for s_m, state, _ in robot.passed if state == "coasting")
    assert step.event is Event.FAIL
    assert step.reason == "rows lost for longer than the profile's longest gap"
    assert step.motion.twist == Twist()
    assert 1.45 < robot.s_m - entered_m < 1.6
    assert evidence(step, "coasted") == (pytest.approx(robot.s_m - entered_m, abs=0.06), 1.5)


def test_a_lane_that_has_become_too_uncertain_stops_the_robot(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING, longest_gap_m=LONG_GAPS_M)
    robot = drawn.robot(crop, drawn.lane(crop, (4.0,) * 3), expected_m=30.0)

    step = robot.follow(to_m=20.0)

    assert step.event is Event.FAIL
    assert step.reason.startswith("without rows the lane's place has become uncertain by 0.0")
    assert step.motion.twist == Twist()
    value, most_m = evidence(step, "offset uncertain by")
    assert most_m == crop.control.most_uncertain_m < value < 1.1 * most_m
    assert 5.0 < robot.s_m < 4.0 + LONG_GAPS_M, "long before the gap is too long"


def test_a_stopped_robot_stays_stopped_between_frames(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING, longest_gap_m=0.3)
    robot = drawn.robot(crop, drawn.lane(crop, (14.0,) * 3))
    robot.plants_m = robot.plants_m[robot.plants_m[:, 1] > 0.2]
    coasting = drawn.states["coasting"](robot.task, robot.direction, robot.memory)
    while not (step := coasting.step(robot.seen(coasting.cameras))).event:
        robot.obey(step.motion.twist)

    robot.ticks += 1
    between = coasting.step(robot.seen(coasting.cameras))

    assert step.event is Event.FAIL
    assert between.evidence == () and between.event is None
    assert between.motion.twist == Twist()


@LAWS
def test_the_robot_coasts_slowly_along_the_line_it_knew(law: ControlLaw, drawn: SimpleNamespace) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (14.0,) * 3, ((3.0, 4.2),)))
    motions = []

    robot.drive("tracking", 2.6)
    robot.drive("coasting", 3.4, lambda step: motions.append(step.motion))

    assert {motion.twist.vx_mps for motion in motions} == {crop.speeds.acquire_mps}
    assert np.abs([motion.twist.yaw_rate_rps for motion in motions]).max() < 0.1
    assert abs(robot.left_m) < 0.02
