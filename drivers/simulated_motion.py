"""The physics of one simulated wheel module: drive ramp, steering servo, currents and warmth.

Nothing here knows of CAN. What the encoders say differs from the truth by the module's errors.
"""

from dataclasses import dataclass
from math import copysign, sqrt

DRIVE_RAMP_MPS2 = 1.5
"""Drive acceleration; the value of the public simulators."""

STEERING_RATE_RPS = 4.0
"""Top steering speed; the value of the public simulators."""

STEERING_ACCELERATION_RPS2 = 40.0
"""Our choice: full steering speed after 0.1 s."""

IDLE_A, ROLLING_A_PER_MPS, DRIVE_A_PER_MPS2 = 0.4, 6.0, 5.0
"""Drive current standing, per speed and per acceleration; our choice, for a 50 kg share of the robot."""

STEERING_A_PER_RPS, STEERING_IDLE_A = 2.0, 0.2
"""Steering current; our choice."""

AMBIENT_C = 22.0
WARMING_C_PER_A2 = 0.25
"""Temperature over the air's that a steady squared ampere leads to; our choice."""

WARMING_S = 600.0
"""Time constant of the controller's warming; our choice."""


@dataclass(frozen=True, slots=True)
class ModuleErrors:
    """What a module does that it was not told: true rim speed over reported, true angle minus reported."""

    speed_factor: float = 1.0
    steering_zero_rad: float = 0.0


class SimulatedMotion:
    """Speed, angle, currents and temperature of one module, as its own sensors see them."""

    def __init__(self) -> None:
        self.speed_mps = 0.0
        self.steering_rad = 0.0
        self.steering_rate_rps = 0.0
        self.drive_current_a = IDLE_A
        self.steering_current_a = STEERING_IDLE_A
        self.temperature_c = AMBIENT_C

    @property
    def steering_share(self) -> float:
        """Steering speed as a share of the top one."""
        return self.steering_rate_rps / STEERING_RATE_RPS

    @property
    def battery_current_a(self) -> float:
        return self.drive_current_a + self.steering_current_a

    def advance(self, dt_s: float, wanted_mps: float, wanted_rad: float | None) -> None:
        """One step towards what is wanted; without a wanted angle the steering brakes and then holds."""
        step_mps = _within(wanted_mps - self.speed_mps, DRIVE_RAMP_MPS2 * dt_s)
        self.speed_mps += step_mps
        self._steer(dt_s, wanted_rad)
        self._load(dt_s, abs(step_mps) / dt_s)

    def _steer(self, dt_s: float, wanted_rad: float | None) -> None:
        error_rad = 0.0 if wanted_rad is None else wanted_rad - self.steering_rad
        braking_rps = sqrt(2 * STEERING_ACCELERATION_RPS2 * abs(error_rad))
        goal_rps = copysign(min(STEERING_RATE_RPS, braking_rps, abs(error_rad) / dt_s), error_rad)
        self.steering_rate_rps += _within(
            goal_rps - self.steering_rate_rps, STEERING_ACCELERATION_RPS2 * dt_s
        )
        self.steering_rad += self.steering_rate_rps * dt_s

    def _load(self, dt_s: float, acceleration_mps2: float) -> None:
        self.drive_current_a = (
            IDLE_A + ROLLING_A_PER_MPS * abs(self.speed_mps) + DRIVE_A_PER_MPS2 * acceleration_mps2
        )
        self.steering_current_a = STEERING_IDLE_A + STEERING_A_PER_RPS * abs(self.steering_rate_rps)
        settled_c = AMBIENT_C + WARMING_C_PER_A2 * self.drive_current_a**2
        self.temperature_c += (settled_c - self.temperature_c) * dt_s / WARMING_S


def _within(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))
