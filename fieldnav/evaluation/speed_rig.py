"""A simulated mission whose loop is timed by itself: pictures are drawn before each round, not within."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, thread_time

from drivers.can_log import LoggedBus, open_virtual_pair
from drivers.compression import compressed
from drivers.ports import Camera
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.evaluation.speed_samples import CROP, ROBOT
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Frame, Side
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.operating import Operating
from fieldnav.mission.simulated import EPOCH
from fieldnav.mission.tape import taping
from fieldnav.mission.taped_bus import TapedBus
from fieldnav.mission.taped_camera import taped_cameras
from fieldnav.mission.tick import Observer
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_robot
from fieldnav.simulation.camera import Renderer, SimulatedCamera
from fieldnav.simulation.plan import FieldPlan, sow
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Task
from states.names import Follow


class DrawnBefore:
    """A simulated camera that draws when it is told to, so that the loop finds its frames ready.

    quality: of their JPEG, where they are recorded; on a robot they are compressed on the camera's thread.
    """

    def __init__(self, camera: Camera, quality: int | None) -> None:
        self._camera, self._quality = camera, quality
        self._drawn: Frame | None = None
        self.frame: Frame | None = None

    def draw(self, now_s: float) -> bool:
        """Draw the newest picture that has arrived; whether it is another than before."""
        before, self._drawn = self._drawn, self._camera.latest(now_s)
        if self._drawn is before or self._drawn is None:
            return False
        self.frame = self._drawn if self._quality is None else compressed(self._drawn, self._quality)
        return True

    def latest(self, now_s: float) -> Frame | None:
        return self.frame

    def close(self) -> None:
        """Nothing to give back."""


@dataclass(frozen=True, slots=True)
class Round:
    """One round of the loop, and whether Tracking got a frame to follow the rows by.

    spent_s: processor time; passed_s: by the clock, with all that the round had to wait for.
    """

    now_s: float
    spent_s: float
    passed_s: float
    tracked: bool


@dataclass(frozen=True, slots=True)
class Rig:
    """The mission and the world that it is driven in."""

    mission: Mission
    operating: Operating
    world: World
    cameras: Mapping[CameraName, DrawnBefore]

    def rounds(self, until_s: float) -> Iterator[Round]:
        """Drive until that time, or until the mission is over."""
        self.operating.start(0.0)
        for tick in range(1, round(until_s / TICK_S) + 1):
            now_s = tick * TICK_S
            self.world.advance(now_s)
            drawn = {name for name, camera in self.cameras.items() if camera.draw(now_s)}
            guided = not drawn.isdisjoint(self.mission.course.behaviours.current.cameras)
            tracked = guided and self.mission.course.machine.leaf[-1] is Follow.TRACKING
            started_s, clock_s = thread_time(), perf_counter()
            self.operating.tick(now_s)
            yield Round(now_s, thread_time() - started_s, perf_counter() - clock_s, tracked)
            if self.mission.over:
                return


@contextmanager
def rigged(
    field: FieldSettings,
    draw: Callable[[FieldPlan, FieldSettings, CropProfile], Renderer],
    watch: Callable[[World], Sequence[Observer]] = lambda world: (),
    record: bool = False,
) -> Iterator[Rig]:
    """The mission through all lanes of a field, with journal and CAN log in a folder that is then removed.

    draw: what makes the pictures; watch: what is to observe the mission in that world; record: as on a robot.
    """
    crop, robot = load_crop(CROP), load_robot(ROBOT)
    plan = sow(field, crop, Side.RIGHT)
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory()))
        host, far_end = open_virtual_pair()
        stack.callback(far_end.shutdown)
        tape = stack.enter_context(taping(RunDirectory(folder), robot, EPOCH, record, waits=False))
        bus = TapedBus(LoggedBus(host, folder / "can.log", robot.can.channel), tape)
        stack.callback(bus.shutdown)
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(robot, far_end, errors, field.wheel_errors.can_delay_s)
        quality = robot.recording.quality if record else None
        world, renderer = World(plan, field, robot, modules), draw(plan, field, crop)
        cameras = {name: DrawnBefore(SimulatedCamera(name, world, renderer), quality) for name in CameraName}
        journal = stack.enter_context(Journal(folder / "journal.jsonl", EPOCH, tape.line))
        pinholes = robot.cameras.pinholes()
        task = Task(crop, pinholes, Side.RIGHT, field.lanes)
        eyes, watching = taped_cameras(tape, cameras, robot), [tape, *watch(world)]
        mission = Mission(robot, task, eyes, ThorvaldWheels(robot, bus), journal, watching)
        yield Rig(mission, Operating(mission, tape), world, cameras)
