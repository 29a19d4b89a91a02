"""A mission on a sketched field, and around it all that can break: cameras, bus, modules, disk, time."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import can
import cv2
from can.interfaces.virtual import VirtualBus

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import FieldnavError
from fieldnav.evaluation.faults_paper import PaperTrail
from fieldnav.evaluation.path import PathObserver
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import CameraName, Side
from fieldnav.mission.driving import JUMPED_S
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.operating import Operating
from fieldnav.mission.pace import RunClock
from fieldnav.mission.tape import Tape
from fieldnav.mission.taped_bus import TapedBus
from fieldnav.mission.taped_camera import taped_cameras
from fieldnav.mission.tick import Tick
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.injection_bus import FaultyBus
from fieldnav.simulation.injection_camera import FaultyCamera
from fieldnav.simulation.injection_intruder import Intruder
from fieldnav.simulation.plan import sow
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Task
from states.names import Path as StatePath

BEGUN = datetime(2000, 1, 1, tzinfo=UTC)


@dataclass(frozen=True, slots=True)
class Setting:
    """Where the mission drives, and with what."""

    field: FieldSettings
    crop: CropProfile
    robot: Robot


class Newest:
    """Keeps the newest tick for those who ask after a round."""

    tick: Tick | None = None

    def watch(self, tick: Tick) -> None:
        self.tick = tick


class Rig:
    """Ticks the mission as a run does; holds the injectors, and `after` each round those who look on."""

    def __init__(self, setting: Setting, folder: Path, tape: Tape | None = None) -> None:
        """tape: what records it, as of a run."""
        tape = tape or Tape()
        cv2.setNumThreads(1)  # a forked process has none of OpenCV's threads
        field, robot = setting.field, setting.robot
        plan = sow(field, setting.crop, Side.RIGHT)
        host, far_end = open_virtual_pair()
        assert isinstance(host, VirtualBus)
        self.bus = FaultyBus(host, field.seed)
        third = VirtualBus(host.channel_id, preserve_timestamps=True)
        taped = TapedBus(self.bus, tape)
        self._buses: tuple[can.BusABC, ...] = (taped, far_end, third)
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        self.modules = SimulatedModules(robot, far_end, errors, field.wheel_errors.can_delay_s)
        self.intruder = Intruder(third)
        self.intruder.nodes = tuple(module.node_id for module in robot.modules.values())
        self.world = World(plan, field, robot, self.modules)
        renderer = SketchRenderer(plan, field, setting.crop)
        self.cameras = {
            name: FaultyCamera(name, SimulatedCamera(name, self.world, renderer)) for name in CameraName
        }
        self.paper, self.path = PaperTrail(folder, BEGUN, tape), PathObserver(self.world)
        pinholes = robot.cameras.pinholes()
        task = Task(setting.crop, pinholes, Side.RIGHT, field.lanes)
        self.newest = Newest()
        self.mission = Mission(
            robot,
            task,
            taped_cameras(tape, self.cameras, robot),
            ThorvaldWheels(robot, taped, clock=tape.clock(lambda: self.now_s + self.stalled_s)),
            self.paper.journal,
            [self.path, self.newest, tape],
            self.paper.ledger,
        )
        self.operating, self._clock = Operating(self.mission, tape), RunClock()
        self.robot, self.crop = robot, setting.crop
        self.now_s, self._ticks = 0.0, 0
        self.absent: list[tuple[float, float]] = []  # spans of time in which the process does not run
        self.stalled_s = 0.0  # for so long the process is kept in the middle of its next round
        self.killed = False
        self.guided_by: tuple[CameraName, ...] = ()  # in the newest round, from its beginning
        self.broken_off = ""
        self.after: list[Callable[[], None]] = []

    @property
    def leaf(self) -> StatePath:
        return self.mission.course.machine.leaf

    @property
    def told_zero(self) -> bool:
        """Whether every module was told to stand at last."""
        return bool(self.bus.told) and not any(self.bus.told.values())

    @property
    def guides(self) -> tuple[CameraName, ...]:
        """The cameras by which the mission goes at this moment."""
        return self.mission.course.behaviours.current.cameras

    def round(self) -> None:
        """Let the world go on by a tick, and the mission where nothing keeps it."""
        self._ticks += 1
        self.now_s = self._ticks * TICK_S
        self.world.advance(self.now_s)
        self.intruder.step(self.now_s)
        for camera in self.cameras.values():
            camera.take(self.now_s)
        if not (self.killed or any(from_s < self.now_s < to_s for from_s, to_s in self.absent)):
            self.guided_by = self.guides
            self.guarded(self._mission_round)
            if self.stalled_s:
                self.absent.append((self.now_s, self.now_s + self.stalled_s))
                self.stalled_s = 0.0
        for look in self.after:
            look()

    def skip_to(self, now_s: float) -> None:
        """Let time pass until a moment without any round of the mission."""
        self._ticks = round(now_s / TICK_S)
        self.now_s = self._ticks * TICK_S
        self.world.advance(self.now_s)

    def guarded(self, act: Callable[[], object]) -> None:
        """Do something to the mission; what it raises ends the run."""
        try:
            act()
        except FieldnavError as error:
            self.broken_off = str(error)

    def _mission_round(self) -> None:
        """A mission that has broken off is over: the run then only tells the wheels to stop."""
        if self.broken_off:
            self.mission.wheels.stop(self.now_s)
            return
        self.operating.tick(self.now_s)
        jumped_s = self._clock.jumped_s()
        if abs(jumped_s) > JUMPED_S:
            self.operating.note(self.now_s, Trouble(FaultKind.WALL_CLOCK, f"by {jumped_s:+.1f} s"))

    def close(self) -> None:
        self.paper.close()
        for bus in self._buses:
            bus.shutdown()
