"""Whether the bus itself is well: how many frames come, and what error frames say."""

import can

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.settings.robot import Bus

FRAME_BITS = 125
"""On the wire, of a frame with eight bytes, its stuffed bits and the gap after it."""
FULLEST = 0.6
"""Share of the bit rate; a robot's own traffic takes a fifth. Our choice."""
BURST_S = 0.25
"""So much at the fullest rate may come at once: a process that was held up for a moment finds it waiting."""
MOST_ERRORS = 20
"""Error frames within a second; a plug that is pulled makes a few. Our choice."""
BUS_OFF_BIT = 0x40
"""In the identifier of socketcan's error frames: the controller has left the bus."""


class BusWatch:
    """A leaky bucket of frames and one of error frames; raises DriverError when either runs over.

    After a pause the frames that waited come round by round: what the bucket could have leaked is kept for
    them until there are no more.
    """

    def __init__(self, settings: Bus) -> None:
        self._frames_per_s = FULLEST * settings.bitrate / FRAME_BITS
        self._most = self._frames_per_s * BURST_S
        self._frames = self._errors = 0.0
        self._judged_s: float | None = None
        self._taken, self._first_s, self._last_s = 0, 0.0, 0.0  # frames since then, and stamps of their ends

    @property
    def most_at_once(self) -> int:
        """Frames that are taken in one go; what is left waits, and the bucket runs over the next time."""
        return int(2 * self._most)

    def take(self, frame: can.Message) -> None:
        """Count a frame. Raises DriverError where it says that the bus is off."""
        self._frames += 1
        if not self._taken:
            self._first_s = frame.timestamp
        self._taken, self._last_s = self._taken + 1, frame.timestamp
        if frame.is_error_frame:
            self._errors += 1
            if frame.arbitration_id & BUS_OFF_BIT:
                raise DriverError("CAN bus: the controller has gone bus-off", FaultKind.BUS_OFF)

    def judge(self, now_s: float) -> None:
        """Let the buckets leak. Raises DriverError for a flood of frames or of errors."""
        if self._judged_s is None:  # what comes first may have waited for any time
            self._frames = self._errors = 0.0
        passed_s = 0.0 if self._judged_s is None else max(0.0, now_s - self._judged_s)
        if self._taken:  # a process that is suspended while it reads goes on in an old round
            passed_s = max(passed_s, self._last_s - self._first_s)
        more_wait = self._taken >= self.most_at_once
        self._judged_s, self._taken = now_s, 0
        self._frames -= passed_s * self._frames_per_s
        if not more_wait:
            self._frames = max(0.0, self._frames)
        self._errors = max(0.0, self._errors - passed_s * MOST_ERRORS)
        if self._frames > self._most:
            waiting, self._frames = self._frames, 0.0
            raise DriverError(
                f"CAN bus: {waiting:.0f} frames beyond {self._frames_per_s:.0f} a second, "
                f"limit {self._most:.0f}",
                FaultKind.BUS_FLOODED,
            )
        if self._errors > MOST_ERRORS:
            errors, self._errors = self._errors, 0.0
            raise DriverError(
                f"CAN bus: {errors:.0f} error frames, limit {MOST_ERRORS} a second", FaultKind.BUS_GARBLED
            )
