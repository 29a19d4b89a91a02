"""The host's side of the bus: the telegrams it sends, and those it takes in."""

from collections.abc import Callable, Iterator
from math import inf

import can

from drivers.bus_watch import BusWatch
from drivers.module_units import speed_to_per_mille, steering_to_per_mille
from drivers.own_frames import OwnFrames
from drivers.reopened_bus import BUS_ERRORS, said
from drivers.thorvald_protocol import Kind, Mode, NmtCommand, NodeState, RoboteqObject, SdoCommand
from drivers.wire_layout import NO_NODE, Telegram, wire_layout
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.settings.robot import Bus, Module

LAST_SEQUENCE = 2**31 - 1
"""RPDO1 counts in a signed 32 bit number; after the last comes 0."""


class HostLine:
    """What the host says to the modules. Every method raises DriverError when the bus refuses."""

    def __init__(
        self, bus: can.BusABC, settings: Bus, clock: Callable[[], float] | None = None, loop_s: float = inf
    ) -> None:
        """clock: the one by which rounds begin, None in simulated time; loop_s: a round's longest time."""
        self._bus, self._own = bus, OwnFrames()
        self._clock, self._loop_s = clock, loop_s
        self._watch = BusWatch(settings)
        self._layout = wire_layout()
        self._refused = ""
        self.sequence = 0

    def received(self, now_s: float) -> Iterator[Telegram]:
        """The telegrams of others that wait on the bus, without waiting; other layouts' frames are left out.

        A telegram without values could not be read. In a flood no more are taken than can be looked at.
        """
        for _ in range(self._watch.most_at_once):
            frame = self._next_frame()
            if frame is None:
                break
            self._watch.take(frame)
            telegram = self._layout.heard(frame)
            if telegram is not None:
                yield telegram
        self._watch.judge(now_s)

    def begin_command(self) -> None:
        """The next round of set-points has a new sequence number."""
        self.sequence = self.sequence + 1 if self.sequence < LAST_SEQUENCE else 0

    def drive(self, now_s: float, module: Module, speed_mps: float) -> None:
        """Speed set-point, clipped to the motor's top speed."""
        speed = speed_to_per_mille(module, speed_mps)
        self._send(now_s, module.node_id, Kind.DRIVE, Sequence=self.sequence, DriveSpeed=speed)

    def steer(self, now_s: float, module: Module, steering_rad: float) -> None:
        """Steering set-point, clipped to the steering limit."""
        angle = steering_to_per_mille(module, steering_rad)
        self._send(now_s, module.node_id, Kind.STEER, MaximumSteeringSpeed=0, SteeringAngle=angle)

    def start_node(self, now_s: float, module: Module) -> None:
        self._send(now_s, NO_NODE, Kind.NMT, Command=NmtCommand.START, Node=module.node_id)

    def beat(self, now_s: float) -> None:
        """The host's own heartbeat."""
        self._send(now_s, NO_NODE, Kind.HOST_HEARTBEAT, State=NodeState.OPERATIONAL)

    def set_mode(self, now_s: float, module: Module, mode: Mode) -> None:
        self._send(now_s, module.node_id, Kind.MODE, Mode=mode, ModeRepeated=mode)

    def read_object(self, now_s: float, module: Module, entry: RoboteqObject, subindex: int = 0) -> None:
        values = {"Command": SdoCommand.READ, "Index": entry, "Subindex": subindex, "Value": 0}
        self._send(now_s, module.node_id, Kind.SDO_REQUEST, **values)

    def set_object(self, now_s: float, module: Module, entry: RoboteqObject) -> None:
        """Write 1 to an object that acts when written."""
        values = {"Command": SdoCommand.WRITE_1_BYTE, "Index": entry, "Subindex": 0, "Value": 1}
        self._send(now_s, module.node_id, Kind.SDO_REQUEST, **values)

    def check_decided(self, now_s: float) -> None:
        """Raise DriverError where the round has taken so long that what it decided no longer holds."""
        spent_s = 0.0 if self._clock is None else self._clock() - now_s
        if not 0 <= spent_s <= self._loop_s:
            said = f"its set-point was decided {spent_s:.2f} s ago, limit {self._loop_s:.2f} s"
            raise DriverError(said, FaultKind.LOOP_LATE)

    def check(self) -> None:
        """Raise once more what the last frame met with, if it did not go out."""
        if self._refused:
            raise DriverError(self._refused)

    def close(self) -> None:
        self._bus.shutdown()

    def _send(self, now_s: float, node: int, kind: Kind, **values: float) -> None:
        frame = self._layout.frame(now_s, node, kind, values)
        try:
            self._own.send(self._bus, frame)
        except BUS_ERRORS as error:
            self._refused = f"CAN bus cannot be written: {said(error)}"
            raise DriverError(self._refused) from error
        self._refused = ""

    def _next_frame(self) -> can.Message | None:
        try:
            return self._own.next_of_others(self._bus, timeout=0)
        except BUS_ERRORS as error:
            raise DriverError(f"CAN bus cannot be read: {said(error)}") from error
