"""What stands however bad the bus: the driver, a mission at rest, modules that nobody started."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from math import isfinite
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import can

from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import DriverError
from fieldnav.evaluation.fuzz_bus import Ends, speeds_told, three_ends
from fieldnav.evaluation.fuzz_can import Bout, Target
from fieldnav.evaluation.fuzz_frames import written
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Frame, Side, Wheel, WheelReport, WheelSetpoint
from fieldnav.mission.loop import Mission
from fieldnav.mission.tick import Tick
from fieldnav.settings.loading import load_crop, load_robot
from fieldnav.settings.robot import Robot
from states.behaviour import Task
from states.names import Event
from states.names import Path as State
from states.table import CHECKING, IDLE, LATCHED, PAUSED, RECOVERABLE

ROBOT, CROP = "bonnbot", "sugar-beet"
EPOCH = datetime(2000, 1, 1, tzinfo=UTC)
RATES = (0.0, 0.1, 0.5, 2.0, 10.0, 100.0)
"""Frames a tick of 20 ms; a bus of 500 kbit/s carries no more than 80."""
RESTART_TICKS = 250
"""The driver is brought up anew every 5 s: refusing once must not protect it from all that follows."""
STANDING = WheelSetpoint(0.0, 0.0)
COMMANDS = frozenset(
    {0x000, *(kind + node for kind in (0x200, 0x300, 0x400, 0x500, 0x600) for node in range(1, 5))}
)
"""Identifiers that a host alone sends; a host that hears them yields to the other, and hears little more."""

MakeWheels = Callable[[Robot, can.BusABC], ThorvaldWheels]


class StandingDriver:
    """A driver that is brought up and told to stand, with modules at the far end or without."""

    over, open = False, True

    def __init__(self, ends: Ends, random: Random, make_wheels: MakeWheels) -> None:
        robot = load_robot(ROBOT)
        self.third = ends.third
        self.rates: Sequence[float] = RATES
        self.left_out = random.choice((frozenset(), COMMANDS))
        self._modules = SimulatedModules(robot, ends.modules) if random.getrandbits(1) else None
        self._wheels = make_wheels(robot, ends.host)
        self._ticks = 0

    def tick(self, now_s: float) -> str:
        if self._modules is not None:
            self._modules.step(now_s)
        if self._ticks % RESTART_TICKS == 0:
            self._wheels.start(now_s)
        self._ticks += 1
        report = WheelReport()
        with suppress(DriverError):
            report = self._wheels.poll(now_s)
        with suppress(DriverError):
            self._wheels.command(now_s, dict.fromkeys(Wheel, STANDING))
        return _told_to_move(self.third) or _not_finite(report)


class BlindCamera:
    """A camera that never gives a frame."""

    def latest(self, now_s: float) -> Frame | None:
        return None

    def close(self) -> None:
        """Nothing to give back."""


class StandingMission:
    """A whole mission in a state in which the wheels must stand."""

    over, open = False, True
    STATES = (IDLE, CHECKING, PAUSED, RECOVERABLE, LATCHED)

    def __init__(self, ends: Ends, random: Random, folder: Path, make_wheels: MakeWheels) -> None:
        robot, crop = load_robot(ROBOT), load_crop(CROP)
        self.third = ends.third
        self.rates: Sequence[float] = RATES
        self.left_out = random.choice((frozenset(), COMMANDS))
        self.journal = Journal(folder / "journal.jsonl", EPOCH)
        self._modules = SimulatedModules(robot, ends.modules) if random.getrandbits(1) else None
        pinholes = robot.cameras.pinholes()
        cameras, wheels = dict.fromkeys(CameraName, BlindCamera()), make_wheels(robot, ends.host)
        task = Task(crop, pinholes, Side.RIGHT, lanes=1)
        self._mission = Mission(robot, task, cameras, wheels, self.journal, [self])
        self._bad_point = ""
        self._bring_to(random.choice(self.STATES))

    def tick(self, now_s: float) -> str:
        if self._modules is not None:
            self._modules.step(now_s)
        self._mission.tick(now_s)
        return _told_to_move(self.third) or self._bad_point

    def watch(self, tick: Tick) -> None:
        """Look at the set-points that the gate let through."""
        for wheel, point in tick.passed.setpoints.items():
            if point.speed_mps != 0 or not isfinite(point.steering_rad):
                self._bad_point = f"the gate gave {wheel.value} {point}"

    def _bring_to(self, state: State) -> None:
        if state == IDLE:
            return
        self._mission.start(0.0)
        events = {PAUSED: Event.PAUSE, RECOVERABLE: Event.FAIL, LATCHED: Event.LATCH}
        if state in events:
            self._mission.break_off(0.0, events[state], "to be fuzzed")


@contextmanager
def standing_driver(bout: Bout, random: Random, make_wheels: MakeWheels = ThorvaldWheels) -> Iterator[Target]:
    with three_ends() as ends:
        yield StandingDriver(ends, random, make_wheels)


@contextmanager
def standing_mission(
    bout: Bout, random: Random, make_wheels: MakeWheels = ThorvaldWheels
) -> Iterator[Target]:
    with three_ends() as ends, TemporaryDirectory(prefix="fieldnav-") as folder:
        target = StandingMission(ends, random, Path(folder), make_wheels)
        try:
            yield target
        finally:
            target.journal.close()


def _told_to_move(third: can.BusABC) -> str:
    """What a host that should stand told a wheel; empty when all it said was zero."""
    moving = [(frame, share) for frame, share in speeds_told(third) if share != 0]
    return f"the host sent {written(moving[0][0])}: {moving[0][1]:+.1%} of the top speed" if moving else ""


def _not_finite(report: WheelReport) -> str:
    for wheel, said in report.modules.items():
        if not all(map(isfinite, (said.speed_mps, said.steering_rad, said.temperature_c, said.battery_v))):
            return f"the driver reports of {wheel.value} what is no number: {said}"
    return ""
