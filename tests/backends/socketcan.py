"""Both ends of a SocketCAN bus for a robot whose time is simulated."""

from collections import deque
from pathlib import Path

import can

from drivers.can_log import open_bus
from fieldnav.settings.robot import Bus

LINES = {"virtual": ("vcan0", "vcan0"), "controllers": ("can0", "can1")}
"""Where host and modules sit: on one virtual line, or each at a controller of its own on one wire."""
ARRIVAL_S = 5.0
"""A frame that was sent comes within microseconds; far longer on an emulated machine that waits."""


def is_there(line: str) -> bool:
    return all(Path("/sys/class/net", name).exists() for name in LINES[line])


class SteppedBus(can.BusABC):
    """One end, for two who take turns: what the other end has sent is awaited, and keeps its own stamp.

    The kernel stamps frames by its clock, and controllers take their time; a robot whose time is
    simulated must see neither. A frame that is lost or changed is awaited in vain and fails the test.
    """

    def __init__(self, channel: str) -> None:
        super().__init__(channel=channel)
        self._bus = open_bus(Bus(interface="socketcan", channel=channel))
        self.coming: deque[can.Message] = deque()
        self.other: SteppedBus | None = None

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        self._bus.send(msg, ARRIVAL_S)
        if self.other is not None:
            self.other.coming.append(msg)

    def recv(self, timeout: float | None = None) -> can.Message | None:
        """What waits; a frame that the other end has not sent has the stamp 0."""
        frame = self._bus.recv(ARRIVAL_S if self.coming else 0)
        assert frame is not None or not self.coming, f"{self.coming[0]} was sent and never came"
        if frame is None:
            return None
        if self.coming and (frame.arbitration_id, frame.data) == self._next:
            frame.timestamp = self.coming.popleft().timestamp
        else:
            frame.timestamp = 0.0
        return frame

    @property
    def _next(self) -> tuple[int, bytearray]:
        return self.coming[0].arbitration_id, self.coming[0].data

    def shutdown(self) -> None:
        super().shutdown()
        self._bus.shutdown()


def open_stepped_pair(line: str) -> tuple[SteppedBus, SteppedBus]:
    """The host's end and that of the modules."""
    host, far = (SteppedBus(name) for name in LINES[line])
    host.other, far.other = far, host
    return host, far
