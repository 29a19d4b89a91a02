"""The robot as a recording has it: cameras and bus that give, round by round, what they gave then."""

from collections import deque
from collections.abc import Sequence

import can

from fieldnav.errors import DriverError
from fieldnav.messages import CameraName, Frame
from fieldnav.recording.records import Lost, Wire


class ReplayedCamera:
    """The Camera port over what was recorded: the newest frame up to this round, or why there was none."""

    def __init__(self, name: CameraName) -> None:
        self.name = name
        self._frame: Frame | None = None
        self._lost: Lost | None = None

    def begin(self, frames: Sequence[Frame], lost: Sequence[Lost]) -> None:
        """A new round, with what came of all cameras in it."""
        self._frame = next((frame for frame in frames if frame.camera is self.name), self._frame)
        self._lost = next((each for each in lost if each.camera is self.name), None)

    def latest(self, now_s: float) -> Frame | None:
        """The newest frame; raises DriverError where the camera gave none."""
        if self._lost is not None:
            raise DriverError(self._lost.said, self._lost.fault)
        return self._frame

    def close(self) -> None:
        """Nothing to give back."""


class ReplayedBus(can.BusABC):
    """The host's end of a bus on which the recorded frames come again; notes what is sent now."""

    def __init__(self) -> None:
        super().__init__(channel="replay")
        self.channel_info = "replay"
        self._coming: deque[Wire] = deque()
        self._sent_then: list[Wire] = []
        self._sent: list[Wire] = []

    def begin(self, wires: Sequence[Wire]) -> None:
        """A new round, with all frames of then."""
        self._coming = deque(wire for wire in wires if not wire.sent)
        self._sent_then = [wire for wire in wires if wire.sent]
        self._sent = []

    @property
    def alike(self) -> bool:
        """Whether this round has sent what was sent then, bit for bit."""
        return self._sent == self._sent_then

    def recv(self, timeout: float | None = None) -> can.Message | None:
        """The next frame of this round. Raises can.CanError where the bus failed then."""
        if not self._coming:
            return None
        wire = self._coming.popleft()
        if wire.error:
            raise can.CanError(wire.error)
        return wire.message()

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Note a frame. Raises can.CanError where the bus refused this one then."""
        index = len(self._sent)
        then = self._sent_then[index] if index < len(self._sent_then) else None
        if then is not None and then.error:
            self._sent.append(then)
            raise can.CanError(then.error)
        self._sent.append(Wire.of(msg, sent=True))
