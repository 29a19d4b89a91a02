"""What a round of the loop costs while it tracks: frame in to CAN frames out, early and late in a lane."""

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

from drivers.can_log import open_virtual_pair
from drivers.ports import Camera
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.evaluation.benchmark import Better, Figure
from fieldnav.evaluation.speed_samples import CROP, FIELD, ROBOT
from fieldnav.evaluation.speed_timing import MILLISECONDS
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Floats, Frame, Side
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.simulated import EPOCH
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Task
from states.names import Follow

GOAL_MS, PERCENTILE = 15.0, 99
EARLY = 0.25  # share of the frames that is early; as many are late
LATE_GOAL = 1.1  # no growth; a tenth is how well two medians can be told apart
APPROACH_S = 12.0  # of getting to tracking, and of lane left over


class DrawnBefore:
    """A simulated camera that draws when it is told to, so that the loop finds its frames ready."""

    def __init__(self, camera: Camera) -> None:
        self._camera = camera
        self.frame: Frame | None = None

    def draw(self, now_s: float) -> bool:
        """Draw the newest picture that has arrived; whether it is another than before."""
        before, self.frame = self.frame, self._camera.latest(now_s)
        return self.frame is not before

    def latest(self, now_s: float) -> Frame | None:
        return self.frame

    def close(self) -> None:
        """Nothing to give back."""


def loop_figures(tracking_s: float) -> list[Figure]:
    """Frame in to CAN frames out while tracking, and whether that grows as the mission goes on."""
    spent_ms = loop_ms(tracking_s)
    part = max(1, int(len(spent_ms) * EARLY))
    growth = float(np.median(spent_ms[-part:]) / np.median(spent_ms[:part]))
    worst = float(np.percentile(spent_ms, PERCENTILE))
    return [
        Figure(
            FIELD,
            "frame in to CAN frame out, 99th percentile (ms)",
            worst,
            None,
            GOAL_MS,
            better=Better.LOWER,
        ),
        Figure(
            FIELD, "frame in to CAN frame out, median (ms)", float(np.median(spent_ms)), better=Better.LOWER
        ),
        Figure(
            FIELD, "cost of a frame late in a lane over early", growth, None, LATE_GOAL, better=Better.LOWER
        ),
    ]


def loop_ms(tracking_s: float) -> Floats:
    """Processor time of each round of the loop in which Tracking got a frame, shape (n,)."""
    crop, robot = load_crop(CROP), load_robot(ROBOT)
    length_m = (tracking_s + APPROACH_S) * crop.speeds.follow_mps
    field = revised(load_field(FIELD), {"length_m": length_m, "lanes": 1})
    plan = sow(field, crop, Side.RIGHT)
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory()))
        host, far_end = open_virtual_pair()
        stack.callback(far_end.shutdown)
        stack.callback(host.shutdown)
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(robot, far_end, errors, field.wheel_errors.can_delay_s)
        world, renderer = World(plan, field, robot, modules), FieldRenderer(plan, field, crop)
        cameras = {name: DrawnBefore(SimulatedCamera(name, world, renderer)) for name in CameraName}
        journal = stack.enter_context(Journal(folder / "journal.jsonl", EPOCH))
        pinholes = {name: robot.cameras.get(name).pinhole() for name in CameraName}
        task = Task(crop, pinholes, Side.RIGHT, lanes=1)
        mission = Mission(robot, task, cameras, ThorvaldWheels(robot, host), journal)
        return _timed(mission, world, cameras, tracking_s)


def _timed(
    mission: Mission, world: World, cameras: Mapping[CameraName, DrawnBefore], seconds: float
) -> Floats:
    """Drive forward; ms of the rounds in which Tracking got a frame, after the world went on and drew."""
    mission.start(0.0)
    spent_s = []
    for tick in range(1, round((seconds + APPROACH_S / 2) / TICK_S)):
        now_s = tick * TICK_S
        world.advance(now_s)
        drawn = {name for name, camera in cameras.items() if camera.draw(now_s)}
        fresh = CameraName.FRONT in drawn and mission.machine.leaf[-1] is Follow.TRACKING
        started_s = process_time()
        mission.tick(now_s)
        if fresh:
            spent_s.append(process_time() - started_s)
    return np.array(spent_s) * MILLISECONDS
