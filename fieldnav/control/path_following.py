"""Path following in the lane's own frame, for a robot that can move sideways and turn independently.

The errors are those of Micaelli and Samson, "Trajectory tracking for unicycle-type and two-steering-wheels
mobile robots" (INRIA research report 2097, 1993): the distance d to the path and the heading theta against
it, d' = vx sin(theta) + vy cos(theta), theta' = w - curvature s'. With two independent steering axles both
are made to die away by themselves, d and theta each over a length of its own, as first-order lags of the
distance driven, so that neither overshoots. Wheels held straight leave the yaw rate alone, which has to see
to both: then the heading is led to where it brings the robot in, a lag behind a lag.
"""

from math import atan, cos, sin, tan

from fieldnav.estimation.lane_state import LaneState
from fieldnav.messages import Motion, Steering, Twist
from fieldnav.settings.crop import Control

LEAST_CLOSING = 0.5
"""s' is never taken for less than this share of the speed: far off the path the formula would run away."""


def follow_path(state: LaneState, speed_mps: float, control: Control) -> Motion:
    """Motion that brings the robot onto the lane and keeps it there, at a speed > 0 along the lane.

    In the frame of the direction of travel; `in_robot_axes` turns it for a robot that drives backward.
    """
    if control.steering is Steering.DIFFERENTIAL:
        return Motion(Twist(speed_mps, 0.0, _turn_alone_rps(state, speed_mps, control)), control.steering)
    steepest = tan(control.steepest_crab_rad)
    inward = _bounded(state.offset_m / control.offset_length_m, steepest)
    aside = -inward - sin(state.heading_rad) - state.sideslip * cos(state.heading_rad)
    vy_mps = speed_mps * _bounded(aside, steepest)
    turn = (
        _along(state) * state.curvature_per_m - state.heading_rad / control.heading_length_m - state.yaw_per_m
    )
    return Motion(Twist(speed_mps, vy_mps, speed_mps * turn), control.steering)


def _turn_alone_rps(state: LaneState, speed_mps: float, control: Control) -> float:
    """Heading led to the angle that brings the robot in, what pushes it sideways allowed for."""
    inward = _bounded(state.offset_m / control.offset_length_m, tan(control.steepest_crab_rad))
    wanted_rad = -atan(inward) - atan(state.sideslip)
    turn = (wanted_rad - state.heading_rad) / control.heading_length_m
    return speed_mps * (_along(state) * state.curvature_per_m + turn - state.yaw_per_m)


def in_robot_axes(motion: Motion, sign: int) -> Motion:
    """The same motion of a robot that travels along its x axis times `sign`; the yaw rate stays."""
    twist = motion.twist
    return Motion(Twist(sign * twist.vx_mps, sign * twist.vy_mps, twist.yaw_rate_rps), motion.steering)


def _along(state: LaneState) -> float:
    """How fast the robot passes along the lane for each metre it drives, s' / vx."""
    return cos(state.heading_rad) / max(LEAST_CLOSING, 1 - state.offset_m * state.curvature_per_m)


def _bounded(value: float, most: float) -> float:
    return max(-most, min(most, value))
