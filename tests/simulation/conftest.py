"""A simulated robot that is driven through the real driver and bus, without any fault but those asked for."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.simulated_motion import ModuleErrors
from drivers.thorvald import ThorvaldWheels
from fieldnav.messages import Side, Wheel, WheelSetpoint
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Robot
from fieldnav.simulation.plan import sow
from fieldnav.simulation.world import World, module_errors

TICK_S = 0.02
READY_S = 2.0
"""By then the modules are up."""

FAULTLESS: dict[str, Any] = {
    "lanes": 1,
    "length_m": 6,
    "start": {"offset_m": 0.0, "heading_deg": 0.0},
    "rows": {"wander_m": 0, "pass_error_m": 0},
    "ground": {"side_slope_deg": 0.0, "slip": 0.0},
    "camera_errors": {
        "shake_deg": 0.0,
        "bounce_m": 0.0,
        "tilt_error_deg": 0.0,
        "height_error_m": 0.0,
        "focal_error": 0.0,
        "yaw_error_deg": 0.0,
    },
    "wheel_errors": {"speed_error": 0.0, "steering_zero_deg": 0.0, "can_delay_s": 0.0},
}

Setpoints = dict[Wheel, WheelSetpoint]
STANDING: Setpoints = {wheel: WheelSetpoint(0.0, 0.0) for wheel in Wheel}


class Driven:
    """A world whose modules are driven through the real driver and bus."""

    def __init__(
        self, field: FieldSettings, robot: Robot, errors: Mapping[Wheel, ModuleErrors] | None = None
    ) -> None:
        self.host, self.far_end = open_virtual_pair()
        drawn = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(robot, self.far_end, errors or drawn, field.wheel_errors.can_delay_s)
        self.plan, self.field, self.robot = sow(field, load_crop(field.crop), Side.RIGHT), field, robot
        self.world = World(self.plan, field, robot, modules)
        self.wheels = ThorvaldWheels(robot, self.host)
        self.ticks = 0
        self.wheels.start(0.0)

    def go(self, setpoints: Setpoints, seconds: float, look: Callable[[float], None] | None = None) -> None:
        for _ in range(round(seconds / TICK_S)):
            self.ticks += 1
            now_s = self.ticks * TICK_S
            self.world.advance(now_s)
            self.wheels.poll(now_s)
            if self.wheels.ready:
                self.wheels.command(now_s, setpoints)
            if look:
                look(now_s)

    def close(self) -> None:
        self.host.shutdown()
        self.far_end.shutdown()


@pytest.fixture
def driven() -> Iterator[Callable[..., Driven]]:
    """Makes a world without any fault but those asked for: group by group, as the field file has them."""
    made: list[Driven] = []

    def make(
        robot: Robot | None = None,
        ready: bool = True,
        errors: Mapping[Wheel, ModuleErrors] | None = None,
        **changes: Any,
    ) -> Driven:
        faults = {
            key: FAULTLESS.get(key, {}) | value if isinstance(value, dict) else value
            for key, value in changes.items()
        }
        field = revised(load_field("demo"), FAULTLESS | faults)
        made.append(Driven(field, robot or load_robot("bonnbot"), errors))
        if ready:
            made[-1].go(STANDING, READY_S)
        return made[-1]

    yield make
    for each in made:
        each.close()
