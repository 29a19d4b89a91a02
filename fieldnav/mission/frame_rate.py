"""How fast a camera's frames come, and how fast one may drive by them."""

from collections import deque

from fieldnav.messages import Frame

KEPT = 6
"""Intervals whose median is taken: lost frames now and then do not slow the robot."""
SLOW = 2.0
"""Times the robot file's interval that frames may be apart before the robot goes slower."""


class FrameRate:
    """The newest intervals of one camera. Frames that nobody looked at do not make it slow."""

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._intervals_s: deque[float] = deque(maxlen=KEPT)
        self._last: Frame | None = None

    def add(self, frame: Frame) -> None:
        """Take in a frame that is newer than all before."""
        last, self._last = self._last, frame
        if last is not None and frame.sequence > last.sequence:
            self._intervals_s.append((frame.stamp_s - last.stamp_s) / (frame.sequence - last.sequence))

    @property
    def _interval_s(self) -> float:
        kept = sorted(self._intervals_s)
        return kept[len(kept) // 2] if len(kept) == KEPT else 0.0

    @property
    def share(self) -> float:
        """Of the speed: as far from frame to frame as at the slowest rate that is no fault; 1 at most."""
        allowed_s = SLOW / self._rate_hz
        return 1.0 if self._interval_s <= allowed_s else allowed_s / self._interval_s

    @property
    def said(self) -> str:
        return f"{1 / self._interval_s:.1f} frames a second, its file says {self._rate_hz:g}"
