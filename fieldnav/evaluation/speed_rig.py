"""A simulated mission whose loop is timed by itself: pictures are drawn before each round, not within."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

from drivers.can_log import LoggedBus, open_virtual_pair
from drivers.ports import Camera
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.evaluation.speed_samples import CROP, ROBOT
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Frame, Side
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.simulated import EPOCH
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


@dataclass(frozen=True, slots=True)
class Round:
    """One round of the loop, its processor time, and whether Tracking got a frame to follow the rows by."""

    now_s: float
    spent_s: float
    tracked: bool


@dataclass(frozen=True, slots=True)
class Rig:
    """The mission and the world that it is driven in."""

    mission: Mission
    world: World
    cameras: Mapping[CameraName, DrawnBefore]

    def rounds(self, until_s: float) -> Iterator[Round]:
        """Drive until that time, or until the mission is over."""
        self.mission.start(0.0)
        for tick in range(1, round(until_s / TICK_S) + 1):
            now_s = tick * TICK_S
            self.world.advance(now_s)
            drawn = {name for name, camera in self.cameras.items() if camera.draw(now_s)}
            guided = not drawn.isdisjoint(self.mission.course.behaviours.current.cameras)
            tracked = guided and self.mission.course.machine.leaf[-1] is Follow.TRACKING
            started_s = process_time()
            self.mission.tick(now_s)
            yield Round(now_s, process_time() - started_s, tracked)
            if self.mission.over:
                return


@contextmanager
def rigged(
    field: FieldSettings,
    draw: Callable[[FieldPlan, FieldSettings, CropProfile], Renderer],
    watch: Callable[[World], Sequence[Observer]] = lambda world: (),
) -> Iterator[Rig]:
    """The mission through all lanes of a field, with journal and CAN log in a folder that is then removed.

    draw: what makes the pictures; watch: what is to observe the mission in that world.
    """
    crop, robot = load_crop(CROP), load_robot(ROBOT)
    plan = sow(field, crop, Side.RIGHT)
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory()))
        host, far_end = open_virtual_pair()
        stack.callback(far_end.shutdown)
        bus = LoggedBus(host, folder / "can.log", robot.can.channel)
        stack.callback(bus.shutdown)
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(robot, far_end, errors, field.wheel_errors.can_delay_s)
        world, renderer = World(plan, field, robot, modules), draw(plan, field, crop)
        cameras = {name: DrawnBefore(SimulatedCamera(name, world, renderer)) for name in CameraName}
        journal = stack.enter_context(Journal(folder / "journal.jsonl", EPOCH))
        pinholes = {name: robot.cameras.get(name).pinhole() for name in CameraName}
        task = Task(crop, pinholes, Side.RIGHT, field.lanes)
        mission = Mission(robot, task, cameras, ThorvaldWheels(robot, bus), journal, watch(world))
        yield Rig(mission, world, cameras)
