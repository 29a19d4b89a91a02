"""Somebody else on the bus: one who floods it, disturbs it, or commands the wheels."""

import can

from drivers.thorvald_protocol import Kind, Mode
from drivers.wire_layout import wire_layout

FOREIGN_ID = 0x555
"""No telegram of the modules' layout."""
FIRST_SEQUENCE = 1_000_000_000
"""Of another host's RPDO1, far from this host's."""


class Intruder:
    """Sends so many frames of each kind at each step; silent until told."""

    def __init__(self, bus: can.BusABC) -> None:
        self._bus, self._sequence = bus, FIRST_SEQUENCE
        self.flood = self.errors = 0
        self.commands_until_s = 0.0
        self.mode: Mode | None = None  # set once, in every module
        self.nodes: tuple[int, ...] = ()

    def step(self, now_s: float) -> None:
        """Say what is due; what others say is not listened to."""
        while self._bus.recv(timeout=0) is not None:
            pass
        for _ in range(self.flood):
            self._bus.send(
                can.Message(timestamp=now_s, arbitration_id=FOREIGN_ID, is_extended_id=False, data=b"\0")
            )
        for _ in range(self.errors):
            self._bus.send(can.Message(timestamp=now_s, is_error_frame=True, is_extended_id=False))
        if now_s < self.commands_until_s:
            self._command(now_s)
        if self.mode is not None:
            self._set_mode(now_s, self.mode)
            self.mode = None

    def _command(self, now_s: float) -> None:
        """A remote with its stick in the middle: every wheel at zero."""
        self._sequence += 1
        for node in self.nodes:
            values = {"Sequence": self._sequence, "DriveSpeed": 0}
            self._bus.send(wire_layout().frame(now_s, node, Kind.DRIVE, values))

    def _set_mode(self, now_s: float, mode: Mode) -> None:
        for node in self.nodes:
            values = {"Mode": mode, "ModeRepeated": mode}
            self._bus.send(wire_layout().frame(now_s, node, Kind.MODE, values))
