"""A robot without a bus: wheels that do what they are told at once, but for their errors, and their world.

The gate already keeps set-points within what the modules can follow, so that nothing is lost by the short cut
that matters where a lane ends; the driver and its frames are measured elsewhere.
"""

from collections.abc import Mapping
from math import hypot
from typing import cast

from drivers.simulated_modules import SimulatedModules
from drivers.simulated_motion import ModuleErrors
from fieldnav.messages import ModuleReport, Wheel, WheelReport, WheelSetpoint
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot
from fieldnav.simulation.body import body_motion
from fieldnav.simulation.plan import FieldPlan
from fieldnav.simulation.world import Motion, World

STANDING = WheelSetpoint(0.0, 0.0)


class ObedientWheels:
    """The Wheels port and, for the world, the modules behind it."""

    ready = True
    taken_over = False
    stops = None

    def __init__(self, errors: Mapping[Wheel, ModuleErrors]) -> None:
        self._errors = errors
        self._told = dict.fromkeys(Wheel, STANDING)

    def start(self, now_s: float) -> None:
        """Nothing needs to come up."""

    def poll(self, now_s: float) -> WheelReport:
        """What the wheels were told is what their own sensors say."""
        reports = {
            wheel: ModuleReport(now_s, told.speed_mps, told.steering_rad)
            for wheel, told in self._told.items()
        }
        return WheelReport(reports)

    def command(self, now_s: float, setpoints: Mapping[Wheel, WheelSetpoint]) -> None:
        self._told.update(setpoints)

    def stop(self, now_s: float) -> None:
        self._told = {wheel: WheelSetpoint(0.0, told.steering_rad) for wheel, told in self._told.items()}

    def emergency_stop(self, now_s: float) -> None:
        self.stop(now_s)

    def release_emergency_stop(self, now_s: float) -> None:
        """They obey again as it is."""

    def close(self) -> None:
        """Nothing to give back."""

    def wheel_states(self) -> Mapping[Wheel, WheelSetpoint]:
        """The wheels' true rim speeds and angles."""
        return {
            wheel: WheelSetpoint(
                told.speed_mps * self._errors[wheel].speed_factor,
                told.steering_rad + self._errors[wheel].steering_zero_rad,
            )
            for wheel, told in self._told.items()
        }


class TickingWorld(World):
    """A world that goes on by whole ticks of the mission."""

    def __init__(self, plan: FieldPlan, field: FieldSettings, robot: Robot, wheels: ObedientWheels) -> None:
        # Of the modules the world only ever asks for the wheels' true states.
        super().__init__(plan, field, robot, cast(SimulatedModules, wheels))

    def advance(self, until_s: float) -> None:
        """Roll on to a time in one step."""
        moved = body_motion(self.wheels(), self.robot.geometry, self.field.ground.slip)
        twist = self._drifting(moved)
        pose = self.now.pose.moved(twist, until_s - self.now.stamp_s)
        attitude = self._shaking.at(until_s, hypot(twist.vx_mps, twist.vy_mps))
        self.now = Motion(until_s, pose, twist, attitude)
        for look in self.after_step:
            look()
