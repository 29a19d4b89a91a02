"""Limits of speed, acceleration, yaw rate and yaw acceleration on what is wanted of the robot."""

from math import hypot

from fieldnav.messages import STANDSTILL, Motion, Steering, Twist
from fieldnav.settings.robot import Limits


def limit(wanted: Motion, previous: Twist, dt_s: float, limits: Limits) -> Motion:
    """The motion nearest to the wanted one that may follow `previous` after `dt_s`.

    Omnidirectional twists change along a straight line, so that the wheels do not swing on the way; so does a
    stop. With `hold` the robot first comes to rest; then the twist only tells a direction.
    """
    target = _slowed(wanted.twist, limits)
    if wanted.hold:
        if previous == STANDSTILL:
            return Motion(target, wanted.steering, hold=True)
        target = STANDSTILL
    linear_mps = hypot(target.vx_mps - previous.vx_mps, target.vy_mps - previous.vy_mps)
    linear = _share(linear_mps, limits.acceleration_mps2 * dt_s)
    yaw = _share(abs(target.yaw_rate_rps - previous.yaw_rate_rps), limits.yaw_acceleration_rps2 * dt_s)
    if wanted.steering is Steering.OMNIDIRECTIONAL or target == STANDSTILL:
        linear = yaw = min(linear, yaw)
    if linear == 1 and yaw == 1:
        return Motion(target, wanted.steering)
    return Motion(
        Twist(
            previous.vx_mps + linear * (target.vx_mps - previous.vx_mps),
            previous.vy_mps + linear * (target.vy_mps - previous.vy_mps),
            previous.yaw_rate_rps + yaw * (target.yaw_rate_rps - previous.yaw_rate_rps),
        ),
        wanted.steering,
    )


def _slowed(twist: Twist, limits: Limits) -> Twist:
    """The twist within the limits of speed and yaw rate, turning about the same centre."""
    speed_mps = hypot(twist.vx_mps, twist.vy_mps)
    share = min(_share(speed_mps, limits.speed_mps), _share(abs(twist.yaw_rate_rps), limits.yaw_rate_rps))
    return Twist(twist.vx_mps * share, twist.vy_mps * share, twist.yaw_rate_rps * share)


def _share(change: float, most: float) -> float:
    """How much of a change fits, 0 to 1."""
    return 1.0 if change <= most else most / change
