"""Metres and radians to the units of a module and back; every constant is the module's own.

A module applies its drive direction and its home count itself (it keeps both without power), so on the wire a
positive speed is forward and zero counts are straight ahead.
"""

from math import pi, tau

from fieldnav.settings.robot import Module

PER_MILLE = 1000
QUADRATURE = 4
"""Counts an encoder pulse gives: both edges of both channels."""

SECONDS_PER_MINUTE = 60


def clipped(value: float, limit: float) -> float:
    """The value held within plus and minus the limit."""
    return max(-limit, min(limit, value))


def speed_to_per_mille(module: Module, speed_mps: float) -> int:
    """Rim speed as RPDO1 carries it, clipped to what the motor can do."""
    return round(PER_MILLE * clipped(speed_mps / module.top_speed_mps, 1))


def speed_from_per_mille(module: Module, per_mille: float) -> float:
    return clipped(per_mille / PER_MILLE, 1) * module.top_speed_mps


def steering_to_per_mille(module: Module, steering_rad: float) -> int:
    """Steering angle as RPDO4 carries it, clipped to the steering limit."""
    return round(PER_MILLE * clipped(steering_rad / module.steering_limit_rad, 1))


def steering_from_per_mille(module: Module, per_mille: float) -> float:
    return clipped(per_mille / PER_MILLE, 1) * module.steering_limit_rad


def speed_to_rpm(module: Module, speed_mps: float) -> int:
    """Motor speed as TPDO1 carries it."""
    return round(speed_mps / module.top_speed_mps * module.motor_max_rpm)


def speed_from_rpm(module: Module, rpm: float) -> float:
    """Rim speed: v = rpm / gear * pi / 30 * radius."""
    return rpm / module.motor_max_rpm * module.top_speed_mps


def counts_per_turn(module: Module) -> float:
    """Encoder counts in one turn of the steered wheel: 175,543 for 1024 pulses."""
    return module.encoder_pulses * QUADRATURE * module.steering_gear


def steering_to_counts(module: Module, steering_rad: float) -> int:
    return round(steering_rad / tau * counts_per_turn(module))


def steering_from_counts(module: Module, counts: float) -> float:
    return counts / counts_per_turn(module) * tau


def steering_rate_to_rpm(module: Module, rate_rps: float) -> int:
    """Steering motor's speed; that TPDO1 carries it in motor rpm is our choice."""
    return round(rate_rps / (2 * pi) * SECONDS_PER_MINUTE * module.steering_gear)
