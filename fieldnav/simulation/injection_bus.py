"""A bus that can be broken: the host's end of the wire, gone, or with a module's telegrams garbled."""

from random import Random

import can

from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout

LONGEST = 8
"""Bytes of a classic CAN frame at most."""
BYTE_VALUES = 256


class FaultyBus(can.BusABC):
    """Passes frames on until it is broken; `told` is what each node was told to drive at last, per mille."""

    def __init__(self, bus: can.BusABC, seed: int = 0) -> None:
        super().__init__(channel=bus.channel_info)
        self.channel_info = f"{bus.channel_info}, breakable"
        self._bus, self._random = bus, Random(seed)
        self.off = False
        self.garbled_node: int | None = None
        self.told: dict[int, float] = {}
        self.commands = 0  # sent so far

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Raises can.CanOperationError while the bus is off."""
        if self.off:
            raise can.CanOperationError("the controller has left the bus")
        self._bus.send(msg, timeout)
        telegram = wire_layout().read(msg)
        if telegram is not None and telegram.kind is Kind.DRIVE:
            self.commands += 1
            self.told[telegram.node] = telegram.values["DriveSpeed"]

    def recv(self, timeout: float | None = None) -> can.Message | None:
        frame = self._bus.recv(timeout)
        if frame is None or self.garbled_node is None:
            return None if self.off else frame
        heard = wire_layout().heard(frame)
        if heard is not None and heard.node == self.garbled_node:
            length = self._random.randint(0, LONGEST)
            frame.data = bytearray(self._random.randrange(BYTE_VALUES) for _ in range(length))
            frame.dlc = length
        return None if self.off else frame

    def shutdown(self) -> None:
        super().shutdown()
        self._bus.shutdown()
