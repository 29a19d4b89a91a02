"""Modules that nobody starts, and which wheels may turn all the same by what was well said on the bus."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from random import Random

import can

from drivers.simulated_modules import SimulatedModules
from fieldnav.evaluation.fuzz_bus import Ends, three_ends
from fieldnav.evaluation.fuzz_can import Bout, Target
from fieldnav.evaluation.fuzz_targets import RATES, ROBOT
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.settings.loading import load_robot
from fieldnav.settings.robot import Robot

NMT, RPDO1, RPDO4 = 0x000, 0x200, 0x500
NMT_BYTES, RPDO_BYTES = 2, 8
START, ALL_NODES = 0x01, 0


class Permits:
    """Listens at an end of the bus; a wheel may turn once its module was started and then told to.

    It reads byte by byte, so that a mistake in the DBC file or in its reader cannot hide another.
    """

    def __init__(self, robot: Robot, bus: can.BusABC) -> None:
        self._nodes = {wheel: module.node_id for wheel, module in robot.modules.items()}
        self._bus = bus
        self._started: set[int] = set()
        self._told: set[tuple[int, int]] = set()

    def listen(self) -> None:
        """Take in all frames that wait."""
        while (frame := self._bus.recv(timeout=0)) is not None:
            if not (frame.is_extended_id or frame.is_remote_frame or frame.is_error_frame):
                self._note(frame.arbitration_id, bytes(frame.data))

    def allow(self, wheel: Wheel, point: WheelSetpoint) -> bool:
        """Whether what the wheel does may be."""
        node = self._nodes[wheel]
        driven, steered = (node, RPDO1) in self._told, (node, RPDO4) in self._told
        return (point.speed_mps == 0 or driven) and (point.steering_rad == 0 or (driven and steered))

    def _note(self, identifier: int, data: bytes) -> None:
        if identifier == NMT and len(data) == NMT_BYTES and data[0] == START:
            self._started |= set(self._nodes.values()) if data[1] == ALL_NODES else {data[1]}
        for node in self._started:
            for kind in (RPDO1, RPDO4):
                if identifier == kind + node and len(data) == RPDO_BYTES:
                    self._told.add((node, kind))


class UnstartedModules:
    """Modules that no host starts; whatever comes, they turn no wheel but as a well-formed command says."""

    over, open = False, True

    def __init__(self, ends: Ends, random: Random) -> None:
        robot = load_robot(ROBOT)
        self.third = ends.third
        self.rates: Sequence[float] = RATES
        self.left_out = random.choice((frozenset(), frozenset({NMT})))
        self._modules = SimulatedModules(robot, ends.modules)
        self._permits = Permits(robot, ends.host)

    def tick(self, now_s: float) -> str:
        self._permits.listen()
        self._modules.step(now_s)
        while self.third.recv(timeout=0) is not None:
            pass  # what the modules say must not pile up
        return next(
            (
                f"{wheel.value} turns without a command: {point}"
                for wheel, point in self._modules.wheel_states().items()
                if not self._permits.allow(wheel, point)
            ),
            "",
        )


@contextmanager
def unstarted_modules(bout: Bout, random: Random) -> Iterator[Target]:
    with three_ends() as ends:
        yield UnstartedModules(ends, random)
