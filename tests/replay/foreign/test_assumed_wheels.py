"""Wheels that nobody has recorded tell the motion that is assumed, whatever they are told."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.control.kinematics import body_twist
from fieldnav.messages import Twist, Wheel, WheelReport, WheelSetpoint
from fieldnav.replay.foreign.container import Told
from fieldnav.replay.foreign.odometry import SILENT_S, ToldTwist
from fieldnav.replay.foreign.wheels import AssumedWheels, steadily
from fieldnav.settings.loading import load_robot

ROBOT = load_robot("bonnbot")


def said(report: WheelReport) -> Twist:
    states = {
        wheel: WheelSetpoint(each.speed_mps, each.steering_rad) for wheel, each in report.modules.items()
    }
    return body_twist(states, ROBOT.geometry)


@given(vx=st.floats(-3, 3), vy=st.floats(-1, 1), yaw_rate=st.floats(-1, 1))
def test_the_wheels_tell_the_motion_that_is_assumed(vx: float, vy: float, yaw_rate: float) -> None:
    wheels = AssumedWheels(ROBOT, steadily(Twist(vx, vy, yaw_rate)))
    wheels.poll(0.0)
    wheels.command(0.0, dict.fromkeys(Wheel, WheelSetpoint(0.0, 0.0)))

    found = said(wheels.poll(0.02))

    assert math.isclose(found.vx_mps, vx, abs_tol=1e-3)
    assert math.isclose(found.vy_mps, vy, abs_tol=1e-3)
    assert math.isclose(found.yaw_rate_rps, yaw_rate, abs_tol=1e-3)


def test_at_the_very_beginning_they_stand() -> None:
    assert said(AssumedWheels(ROBOT, steadily(Twist(0.5))).poll(0.0)) == Twist()


def message(stamp_ns: int, vx_mps: float) -> Told:
    linear, angular = SimpleNamespace(x=vx_mps, y=0.0), SimpleNamespace(z=0.1)
    twist = SimpleNamespace(twist=SimpleNamespace(twist=SimpleNamespace(linear=linear, angular=angular)))
    return Told(stamp_ns, stamp_ns, "nav_msgs/msg/Odometry", twist)


def test_odometry_holds_until_the_next_word_and_not_for_long() -> None:
    moved = ToldTwist(iter([message(1_000_000_000, 0.4), message(1_200_000_000, 0.6)]), 1_000_000_000)

    assert moved(0.1) == Twist(0.4, 0.0, 0.1)
    assert moved(0.25).vx_mps == pytest.approx(0.6)
    assert moved(0.2 + SILENT_S + 0.01) == Twist()
