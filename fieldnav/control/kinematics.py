"""Body twist to wheel set-points and back, for four wheels that each drive and steer."""

from collections.abc import Mapping
from math import atan2, copysign, cos, hypot, inf, pi, radians, sin

from fieldnav.messages import STANDSTILL, Motion, Steering, Twist, Wheel, WheelSetpoint
from fieldnav.settings.robot import Geometry, Limits

STILL_MPS = 1e-4
"""Slower than this a wheel has no direction of its own; far below the 1.5 mm/s of one step on the bus."""


def wheel_setpoints(
    motion: Motion,
    geometry: Geometry,
    present: Mapping[Wheel, float],
    limits: Limits,
    steering_limit_rad: float = pi,
) -> dict[Wheel, WheelSetpoint]:
    """What each wheel must do for this motion, given the present steering angles in radians (0 when absent).

    No rim is faster than the speed limit: all are slowed alike, so the centre of rotation stays. With `hold`
    the angles are those of the twist and the speeds zero. DIFFERENTIAL leaves sideways velocity out.
    """
    if motion.steering is Steering.DIFFERENTIAL:
        wanted = {
            wheel: WheelSetpoint(_straight_speed_mps(motion.twist, geometry, wheel), 0.0) for wheel in Wheel
        }
    else:
        wanted = {
            wheel: _turned(
                _velocity_mps(motion.twist, geometry, wheel),
                present.get(wheel, 0.0),
                limits,
                steering_limit_rad,
            )
            for wheel in Wheel
        }
    fastest_mps = max(abs(setpoint.speed_mps) for setpoint in wanted.values())
    share = 0.0 if motion.hold else min(1.0, limits.speed_mps / max(fastest_mps, STILL_MPS))
    return {
        wheel: WheelSetpoint(setpoint.speed_mps * share, setpoint.steering_rad)
        for wheel, setpoint in wanted.items()
    }


def body_twist(states: Mapping[Wheel, WheelSetpoint], geometry: Geometry) -> Twist:
    """The twist that agrees best, by least squares of the slip, with what at least two wheels do.

    Fewer than two wheels say nothing of the yaw rate: it is then zero.
    """
    if not states:
        return STANDSTILL
    places = [geometry.position_m(wheel) for wheel in states]
    velocities = [
        (state.speed_mps * cos(state.steering_rad), state.speed_mps * sin(state.steering_rad))
        for state in states.values()
    ]
    mean_x, mean_y = _mean(places)
    mean_vx, mean_vy = _mean(velocities)
    turning = spread = 0.0
    for (x, y), (vx, vy) in zip(places, velocities, strict=True):
        turning += (x - mean_x) * (vy - mean_vy) - (y - mean_y) * (vx - mean_vx)
        spread += (x - mean_x) ** 2 + (y - mean_y) ** 2
    yaw_rate_rps = turning / spread if spread > 0 else 0.0
    return Twist(mean_vx + yaw_rate_rps * mean_y, mean_vy - yaw_rate_rps * mean_x, yaw_rate_rps)


def _velocity_mps(twist: Twist, geometry: Geometry, wheel: Wheel) -> tuple[float, float]:
    """Velocity of the wheel's place: perpendicular to its line from the instantaneous centre of rotation."""
    x, y = geometry.position_m(wheel)
    return twist.vx_mps - twist.yaw_rate_rps * y, twist.vy_mps + twist.yaw_rate_rps * x


def _straight_speed_mps(twist: Twist, geometry: Geometry, wheel: Wheel) -> float:
    """Rim speed of a wheel that points ahead.

    Four straight wheels yaw only by slipping sideways. Where friction is alike at all of them, the robot yaws
    as if its track were (wheelbase^2 + track^2) / track; that is also what `body_twist` makes of the speeds.
    """
    x, y = geometry.position_m(wheel)
    return twist.vx_mps - twist.yaw_rate_rps * (x * x + y * y) / y


def _turned(
    velocity_mps: tuple[float, float], present_rad: float, limits: Limits, steering_limit_rad: float
) -> WheelSetpoint:
    """Along the velocity driving forwards, or opposite to it driving backwards; at standstill as it is."""
    speed_mps = hypot(*velocity_mps)
    if speed_mps < STILL_MPS:
        return WheelSetpoint(0.0, present_rad)
    along_rad = atan2(velocity_mps[1], velocity_mps[0])
    if abs(along_rad) == pi:  # straight back is on both sides; it is nearer on the wheel's own
        along_rad = copysign(pi, present_rad)
    against_rad = along_rad - copysign(pi, along_rad)
    if _inverts(along_rad, against_rad, present_rad, limits, steering_limit_rad):
        return WheelSetpoint(-speed_mps, against_rad)
    return WheelSetpoint(speed_mps, along_rad)


def _inverts(
    along_rad: float, against_rad: float, present_rad: float, limits: Limits, steering_limit_rad: float
) -> bool:
    """Whether the wheel turns the other way and reverses.

    It does past the inversion angle and the hysteresis; and rather than point far backward it looks ahead, so
    that the way to straight stays short, unless it is as good as there.
    """
    hysteresis_rad = radians(limits.wheel_inversion_hysteresis_deg)
    inversion_rad = radians(limits.wheel_inversion_deg)
    reach_rad = inversion_rad + 2 * hysteresis_rad
    turn_rad = abs(along_rad - present_rad)
    near = turn_rad <= hysteresis_rad
    if abs(along_rad) > min(inf if near else reach_rad, steering_limit_rad):
        return abs(against_rad) <= steering_limit_rad
    return turn_rad > inversion_rad + hysteresis_rad and abs(against_rad) <= min(
        reach_rad, steering_limit_rad
    )


def _mean(pairs: list[tuple[float, float]]) -> tuple[float, float]:
    return sum(x for x, _ in pairs) / len(pairs), sum(y for _, y in pairs) / len(pairs)
