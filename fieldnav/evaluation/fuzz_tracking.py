"""A mission that follows a lane of a sketched field while bad frames arrive beside the good ones.

It may stop. It may not drive faster than its limits, nor further off the lane than it would have alone.
"""

from collections.abc import Sequence
from math import hypot, inf, isfinite

import numpy as np

from drivers.simulated_modules import SimulatedModules
from fieldnav.evaluation.fuzz_bus import Ends, speeds_told
from fieldnav.evaluation.fuzz_frames import NODE_BITS, written
from fieldnav.evaluation.fuzz_targets import COMMANDS, MakeWheels
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Side
from fieldnav.mission.loop import Mission
from fieldnav.mission.tick import Tick
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Task
from states.names import Follow
from states.table import LANE_LEAVES

AFTER_S, LONGEST_S = 1.0, 60.0
"""So long after it went to a state that stands every wheel must stand; so long a lane may take."""
STILL_MPS = 1e-3
WIRE_STEP = 0.001
"""One step of RPDO1, as a share of the top speed."""
LANE = 0


class TrackingMission:
    """The mission, its world, and what the gate let through."""

    def __init__(
        self, ends: Ends, robot: Robot, field: FieldSettings, journal: Journal, make_wheels: MakeWheels
    ) -> None:
        crop, errors = load_crop(field.crop), module_errors(field.wheel_errors, field.seed, field.mirrored)
        plan = sow(field, crop, Side.RIGHT)
        modules = SimulatedModules(robot, ends.modules, errors, field.wheel_errors.can_delay_s)
        self.third, self.furthest_m, self.open = ends.third, 0.0, False
        self.rates: Sequence[float] = (0.0,)
        self.left_out = COMMANDS
        self._world = World(plan, field, robot, modules)
        renderer = SketchRenderer(plan, field, crop)
        cameras = {name: SimulatedCamera(name, self._world, renderer) for name in CameraName}
        pinholes = robot.cameras.pinholes()
        task, wheels = Task(crop, pinholes, Side.RIGHT, 1), make_wheels(robot, ends.host)
        self._mission = Mission(robot, task, cameras, wheels, journal, [self])
        self._limit_mps = robot.limits.speed_mps
        self._top_mps = {module.node_id: module.top_speed_mps for module in robot.modules.values()}
        self._fastest_mps = self._limit_mps * (1 + field.wheel_errors.speed_error)
        self._allowed_m = inf
        self._bad_point, self._now_s = "", 0.0
        self._ended_s: float | None = None
        self._standing_s: float | None = None
        self._mission.start(0.0)

    def challenge(self, rate: float, left_out: frozenset[int], allowed_m: float) -> None:
        """Throw so many frames a tick at it; it is a fault to be further off the lane than is allowed."""
        self.rates, self.left_out, self._allowed_m = (rate,), left_out, allowed_m

    @property
    def over(self) -> bool:
        ended = self._ended_s is not None and self._now_s - self._ended_s > AFTER_S
        return ended or self._now_s > LONGEST_S

    def tick(self, now_s: float) -> str:
        self._now_s = now_s
        self._world.advance(now_s)
        self._mission.tick(now_s)
        if self._ended_s is None and self._mission.over:
            self._ended_s = now_s
        self.furthest_m = max(self.furthest_m, self._aside_m())
        return self._too_fast() or self._bad_point or self._strayed() or self._never_rests()

    def watch(self, tick: Tick) -> None:
        """Look at the set-points that the gate let through; frames are thrown once it tracks."""
        self.open = self.open or tick.state[-1] is Follow.TRACKING
        if tick.state in LANE_LEAVES:
            self._standing_s = None
        elif self._standing_s is None:
            self._standing_s = tick.now_s
        for wheel, point in tick.passed.setpoints.items():
            if not (isfinite(point.steering_rad) and abs(point.speed_mps) <= self._limit_mps + WIRE_STEP):
                self._bad_point = f"the gate gave {wheel.value} {point}, limit {self._limit_mps} m/s"

    def _too_fast(self) -> str:
        for frame, share in speeds_told(self.third):
            top_mps = self._top_mps[frame.arbitration_id & NODE_BITS]
            speed_mps = abs(share) * top_mps
            if speed_mps > self._limit_mps + WIRE_STEP * top_mps:
                return f"the host sent {written(frame)}: {speed_mps:.2f} m/s, limit {self._limit_mps} m/s"
        twist = self._world.now.twist
        speed_mps = hypot(twist.vx_mps, twist.vy_mps)
        return "" if speed_mps <= self._fastest_mps else f"the robot drives {speed_mps:.2f} m/s"

    def _strayed(self) -> str:
        if self.furthest_m <= self._allowed_m:
            return ""
        return f"{self.furthest_m:.2f} m off the lane, where {self._allowed_m:.2f} m are allowed"

    def _never_rests(self) -> str:
        """Wheels that turn although the mission has been in a state that stands for long enough."""
        if self._standing_s is None or self._now_s - self._standing_s < AFTER_S:
            return ""
        fastest_mps = max(abs(state.speed_mps) for state in self._world.wheels().values())
        return (
            "" if fastest_mps < STILL_MPS else f"the mission stands and wheels turn at {fastest_mps:.2f} m/s"
        )

    def _aside_m(self) -> float:
        pose = self._world.now.pose
        return abs(float(self._world.plan.in_lane(LANE, np.array([pose.x_m, pose.y_m]))[1]))
