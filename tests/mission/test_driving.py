"""What a person asks of a run on the wall clock: above all, a reset opens a bus again that was lost."""

from collections.abc import Iterator
from pathlib import Path

import can
import pytest
from can.interfaces.virtual import VirtualBus

from drivers.can_log import LoggedBus, open_virtual_pair
from drivers.reopened_bus import ReopenedBus
from fieldnav.errors import DriverError
from fieldnav.mission.driving import Driving
from fieldnav.mission.operating import Operating
from fieldnav.mission.pace import Pace, RunClock
from fieldnav.mission.status_board import StatusBoard
from fieldnav.operator.request import Answer, Command, Request
from states.names import Follow
from states.table import LATCHED


class Pulled(VirtualBus):
    """Lost as soon as its adapter is pulled; closed, it fails as python-can's socketcand does."""

    lost = False

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        if self.lost:
            raise BrokenPipeError("Broken pipe")
        super().send(msg, timeout)

    def recv(self, timeout: float | None = None) -> can.Message | None:
        if not self._open:
            raise ValueError("file descriptor cannot be a negative integer (-1)")
        if self.lost:
            raise can.CanError(
                "Failed to receive: Broken pipe  Traceback (most recent call last):\n  File x\n"
            )
        return super().recv(timeout)


class Adapter:
    """What a bus is opened on: it can be pulled and plugged in again."""

    def __init__(self, channel: str) -> None:
        self._channel = channel
        self.opened: list[Pulled] = []
        self.plugged = True

    def open(self) -> can.BusABC:
        if not self.plugged:
            raise DriverError("CAN bus cannot be opened: no such adapter")
        self.opened.append(Pulled(self._channel, preserve_timestamps=True))
        return self.opened[-1]

    def pull(self) -> None:
        self.plugged = False
        self.opened[-1].lost = True


class Asking:
    """An operator who asks one thing after another."""

    def __init__(self) -> None:
        self.waiting: list[Command] = []
        self.answers: list[Answer] = []

    def poll(self, now_s: float) -> tuple[Request, ...]:
        asked, self.waiting = self.waiting, []
        return tuple(Request(command, "a test", self.answers.append) for command in asked)


class Scene:
    """A rig on a bus that can be pulled, and a run that asks its operator."""

    def __init__(self, rig, adapter: Adapter, bus: ReopenedBus, log: LoggedBus) -> None:
        self.rig, self.adapter, self.asking = rig, adapter, Asking()
        clock = RunClock()
        self._driving = Driving(
            rig.mission,
            Operating(rig.mission),
            StatusBoard("a-run", 1),
            log,
            [self.asking],
            Pace(clock, lambda seconds: None),
            clock,
            bus.reopen,
        )

    def reset(self) -> Answer:
        self.asking.waiting.append(Command.RESET)
        self._driving._answer(self.rig.now_s)
        return self.asking.answers[-1]


@pytest.fixture
def scene(rig_with, tmp_path: Path) -> Iterator[Scene]:
    """It drives already."""
    host, far = open_virtual_pair()
    adapter = Adapter(host.channel_id)
    host.shutdown()
    bus = ReopenedBus(adapter.open)
    log = LoggedBus(bus, tmp_path / "can.log", "can0")
    yield Scene(rig_with(None, (log, far)), adapter, bus, log)


def test_a_reset_opens_a_bus_again_that_was_lost_and_the_mission_goes_on(scene: Scene) -> None:
    scene.adapter.pull()
    scene.rig.run(1.0)
    assert scene.rig.mission.course.machine.leaf == LATCHED
    assert "Broken pipe" in scene.rig.lines()[-1].reason
    assert "Traceback" not in scene.rig.lines()[-1].reason
    scene.adapter.plugged = True

    answer = scene.reset()
    scene.rig.run(8.0)

    assert answer.ok, answer.said
    assert Follow.TRACKING in scene.rig.mission.course.machine.leaf
    assert scene.rig.fastest_mps() > 0.3


def test_a_reset_of_a_bus_that_is_not_there_yet_says_so_and_changes_nothing(scene: Scene) -> None:
    scene.adapter.pull()
    scene.rig.run(1.0)

    assert scene.reset().said == "CAN bus cannot be opened: no such adapter"
    scene.rig.run(1.0)
    assert scene.rig.mission.course.machine.leaf == LATCHED
    scene.adapter.plugged = True
    assert scene.reset().ok


def test_a_bus_that_is_well_is_not_opened_again_by_a_reset(scene: Scene) -> None:
    scene.reset()

    assert len(scene.adapter.opened) == 1
