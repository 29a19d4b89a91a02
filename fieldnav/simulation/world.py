"""The world of a simulated run: the sown field, the robot's true pose, and time in small steps."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import atan2, cos, hypot, radians, sin

from drivers.simulated_modules import SimulatedModules
from drivers.simulated_motion import ModuleErrors
from fieldnav.messages import Twist, Wheel, WheelSetpoint
from fieldnav.odometry import Pose
from fieldnav.settings.field import FieldSettings, WheelErrors
from fieldnav.settings.robot import Robot
from fieldnav.simulation.body import body_motion
from fieldnav.simulation.plan import FieldPlan
from fieldnav.simulation.shaking import Attitude, Shaking
from fieldnav.simulation.streams import Stream, random_stream

STEP_S = 0.005
CORNERING_STIFFNESS = 4.0
"""Side force over load, per radian of slip angle, of a wide tyre on loose soil; our choice."""
STANDING_MPS = 0.005
"""Static friction holds a wheel that hardly rolls on the slope."""
FIRST_PLANTS_SEEN = 0.35
"""The robot is set down so that the rows begin this share of the way up the leading view."""


@dataclass(frozen=True, slots=True)
class Motion:
    """The truth at one moment."""

    stamp_s: float
    pose: Pose
    twist: Twist
    attitude: Attitude


class World:
    """Advances the robot by what its wheel modules truly do."""

    def __init__(
        self, plan: FieldPlan, field: FieldSettings, robot: Robot, modules: SimulatedModules
    ) -> None:
        self.plan, self.field, self.robot = plan, field, robot
        self._modules = modules
        self._mirror = -1 if field.mirrored else 1
        self._shaking = Shaking(field.camera_errors, field.seed, field.mirrored)
        self.now = Motion(0.0, self._start(), Twist(), Attitude())
        self.after_step: list[Callable[[], None]] = []

    def advance(self, until_s: float) -> None:
        """Let the modules and the body go on to a time; the step is STEP_S."""
        steps = max(1, round((until_s - self.now.stamp_s) / STEP_S))
        start_s = self.now.stamp_s
        for step in range(1, steps + 1):
            stamp_s = start_s + (until_s - start_s) * step / steps
            self._modules.step(stamp_s)
            twist = self._drifting(body_motion(self.wheels(), self.robot.geometry, self.field.ground.slip))
            pose = self.now.pose.moved(twist, stamp_s - self.now.stamp_s)
            speed_mps = hypot(twist.vx_mps, twist.vy_mps)
            self.now = Motion(stamp_s, pose, twist, self._shaking.at(stamp_s, speed_mps))
            for look in self.after_step:
                look()

    def wheels(self) -> Mapping[Wheel, WheelSetpoint]:
        """What the wheels truly do."""
        return self._modules.wheel_states()

    def _drifting(self, twist: Twist) -> Twist:
        """Add the slip down the side slope: gravity's side force over the tyres' cornering stiffness."""
        speed_mps = hypot(twist.vx_mps, twist.vy_mps)
        if speed_mps < STANDING_MPS:
            return twist
        slope = sin(radians(self.field.ground.side_slope_deg)) * self._mirror
        drift_mps = -speed_mps * slope / CORNERING_STIFFNESS  # along the world's y: its left side is higher
        heading = self.now.pose.heading_rad
        along, across = drift_mps * sin(heading), drift_mps * cos(heading)
        if abs(twist.vy_mps) > abs(twist.vx_mps):  # rolling up or down the slope the drive holds the body
            return twist
        return Twist(twist.vx_mps + along, twist.vy_mps + across, twist.yaw_rate_rps)

    def _start(self) -> Pose:
        """Before the first lane, with a small error of setting down."""
        random = random_stream(self.field.seed, Stream.START)
        offset_m, turn_rad = random.uniform(-1, 1, 2) * (
            self.field.start.offset_m,
            radians(self.field.start.heading_deg),
        )
        near_m, far_m = self.robot.cameras.front.pinhole().view_m
        s = float(self.plan.s_first_m[0].mean()) - near_m - FIRST_PLANTS_SEEN * (far_m - near_m)
        x, y = self.plan.centreline.position(s, float(self._mirror * offset_m))
        # The lane's own direction over the first metres, which the rows' wandering turns a little.
        ahead = self.plan.centreline.position(s + far_m, 0.0) - self.plan.centreline.position(s, 0.0)
        heading = atan2(float(ahead[1]), float(ahead[0]))
        return Pose(float(x), float(y), heading + float(self._mirror * turn_rad))


def module_errors(errors: WheelErrors, seed: int, mirrored: bool) -> dict[Wheel, ModuleErrors]:
    """Each module's speed factor and steering zero; in a mirrored field left and right change places."""
    random = random_stream(seed, Stream.WHEEL_ERRORS)
    drawn = {wheel: random.uniform(-1, 1, 2) for wheel in Wheel}
    result = {}
    for wheel, (speed, steering) in drawn.items():
        zero_rad = radians(errors.steering_zero_deg) * float(steering) * (-1 if mirrored else 1)
        place = _OPPOSITE[wheel] if mirrored else wheel
        result[place] = ModuleErrors(1 + errors.speed_error * float(speed), zero_rad)
    return result


_OPPOSITE = {
    Wheel.FRONT_LEFT: Wheel.FRONT_RIGHT,
    Wheel.FRONT_RIGHT: Wheel.FRONT_LEFT,
    Wheel.REAR_LEFT: Wheel.REAR_RIGHT,
    Wheel.REAR_RIGHT: Wheel.REAR_LEFT,
}
