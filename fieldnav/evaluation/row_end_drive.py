"""One lane driven to its end by the real perception, states and gate, over a sketched field without a bus."""

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np

from fieldnav.evaluation.row_end_robot import ObedientWheels, TickingWorld
from fieldnav.evaluation.row_end_witness import LANE, Notes, Witness
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Side
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Task
from states.memory import LaneMemory
from states.names import Event

EPOCH = datetime(2000, 1, 1, tzinfo=UTC)
SLOWEST, SPARE_S = 0.3, 60.0
"""A lane that takes longer than at this share of the working speed, and this, is not driven on."""
MISSED_M = 0.3
"""So far from where it should stop a robot has missed the lane's end."""


@dataclass(frozen=True, slots=True)
class LaneRun:
    """A lane to be driven; `expected_m`: how long the lanes before it were, None where there were none."""

    field: FieldSettings
    crop: CropProfile
    robot: Robot
    expected_m: float | None = None

    @property
    def title(self) -> str:
        known = "" if self.expected_m is None else f", expected {self.expected_m:.1f} m"
        field = self.field
        return f"{field.name}, {self.crop.name}, {field.length_m:g} m, seed {field.seed}{known}"


@dataclass(frozen=True, slots=True)
class LaneEnding:
    """How a lane was driven and left.

    error_m: how far past the right place the robot left it, NaN where it never did; false_end: it left it
    before the trailing camera had passed the last plant; stopped: why it gave up, empty where it did not.
    """

    run: LaneRun
    driven_m: float
    error_m: float
    false_end: bool
    stopped: str
    notes: Notes

    @property
    def missed(self) -> bool:
        """Left too late or too early, or not at all, but not falsely."""
        return not self.false_end and not self.stopped and not abs(self.error_m) <= MISSED_M

    @property
    def returns(self) -> int:
        """How often crop came again after the lane had been taken for ended."""
        return sum(each.event is Event.ROWS_SEEN_AGAIN for each in self.notes.happenings)


def drive_to_end(run: LaneRun) -> LaneEnding:
    """Drive the first lane of the run's field and judge how it was left. Raises FieldnavError."""
    cv2.setNumThreads(1)
    field, robot = run.field, run.robot
    plan = sow(field, run.crop, Side.RIGHT)
    wheels = ObedientWheels(module_errors(field.wheel_errors, field.seed, field.mirrored))
    world = TickingWorld(plan, field, robot, wheels)
    renderer = SketchRenderer(plan, field, run.crop)
    cameras = {name: SimulatedCamera(name, world, renderer) for name in CameraName}
    pinholes = robot.cameras.pinholes()
    task, witness = Task(run.crop, pinholes, Side.RIGHT, lanes=1), Witness(world)
    with TemporaryDirectory(prefix="fieldnav-") as folder, Journal(Path(folder) / "j", EPOCH) as journal:
        mission = Mission(robot, task, cameras, wheels, journal, [witness])
        mission.course.behaviours.lane = LaneMemory(number=1, expected_m=run.expected_m)
        begun_m = witness.place_m()
        _drive(mission, world, field.length_m / (SLOWEST * run.crop.speeds.follow_mps) + SPARE_S)
    return _judged(run, world, witness, witness.place_m() - begun_m)


def _drive(mission: Mission, world: World, limit_s: float) -> None:
    mission.start(0.0)
    ticks = 0
    while not mission.over:
        ticks += 1
        now_s = ticks * TICK_S
        world.advance(now_s)
        mission.tick(now_s)
        if now_s > limit_s:
            mission.break_off(now_s, Event.FAIL, f"not ended within {limit_s:.0f} s of the robot's time")


def _judged(run: LaneRun, world: World, witness: Witness, driven_m: float) -> LaneEnding:
    left = [each for each in witness.notes.happenings if each.event is Event.LAST_LANE_LEFT]
    stopped = [each for each in witness.notes.happenings if each.event in (Event.FAIL, Event.LATCH)]
    _, last_m = world.plan.lane_span_m(LANE)
    headland_m = run.crop.switching.headland_m
    stop_m = last_m + headland_m + run.robot.cameras.rear.distance_m
    error_m = left[0].s_m - stop_m if left else float(np.nan)
    reason = stopped[0].reason or stopped[0].event.value if stopped else ""
    return LaneEnding(run, driven_m, error_m, error_m < -headland_m, reason, witness.notes)
