"""A robot on a real virtual bus and simulated time: whoever waits lets the modules go on."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import can
import pytest
from can.interfaces.virtual import VirtualBus

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.preflight.computer import Computer
from fieldnav.preflight.finding import Finding
from fieldnav.preflight.gear import Gear
from fieldnav.preflight.preflight import preflight
from fieldnav.preflight.waiting import Watch
from fieldnav.settings.loading import load_robot
from fieldnav.settings.robot import Robot

TICK_S = 0.02


@dataclass
class BusBench:
    """The host's bus with the modules and the battery at its far end; `events` happen at every tick."""

    robot: Robot
    host: can.BusABC
    far: can.BusABC
    tap: can.BusABC
    modules: SimulatedModules
    computer: Computer
    running: bool = True
    now_s: float = 0.0
    events: list[Callable[[], None]] = field(default_factory=list)

    def check(self) -> dict[str, Finding]:
        """What is found on the bus, by check."""
        watch = Watch(lambda: self.now_s, self._wait)
        findings = preflight(self.robot, None, Gear(self.host, {}), self.computer, watch)
        return {finding.check: finding for finding in findings}

    def say(self, node: int, kind: Kind, **values: float) -> None:
        """A frame of somebody else."""
        self.far.send(wire_layout().frame(self.now_s, node, kind, values))

    def sent(self) -> list[can.Message]:
        """What the host has sent, as a third party hears it."""
        heard = []
        while (frame := self.tap.recv(timeout=0)) is not None:
            heard.append(frame)
        commands = [first + node for first in (0x200, 0x400, 0x500, 0x600) for node in range(1, 5)]
        return [frame for frame in heard if frame.arbitration_id in (0x000, 0x77F, *commands)]

    def _wait(self, seconds: float) -> None:
        until_s = round(self.now_s + seconds, 9)
        while self.now_s < until_s:
            self.now_s = round(min(until_s, self.now_s + TICK_S), 9)
            if self.running:
                self.modules.step(self.now_s)
            for event in self.events:
                event()


@pytest.fixture
def bench(computer: Computer) -> Iterator[BusBench]:
    robot = load_robot("bonnbot")
    host, far = open_virtual_pair()
    tap = VirtualBus(host.channel_id, preserve_timestamps=True)  # type: ignore[attr-defined]
    yield BusBench(robot, host, far, tap, SimulatedModules(robot, far), computer)
    for bus in (host, far, tap):
        bus.shutdown()
