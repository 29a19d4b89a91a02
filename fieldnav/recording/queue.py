"""What waits to be written, bounded in bytes: pictures give way first, the loop never waits."""

from collections import deque
from dataclasses import dataclass
from threading import Condition

from fieldnav.recording.message import Recordable

PATIENCE_S = 0.1
"""How long a picture waits for what comes after it before the writer looks by itself."""

BOUNDS_OF_OTHERS = 2
"""Bounds within which what is no picture is let in: little as it is, it goes on well after pictures."""


@dataclass(frozen=True, slots=True)
class Waiting:
    """What waits, the bytes it holds, and how much was left out just before it."""

    item: Recordable
    size: int
    pictures_before: int
    others_before: int


class BoundedQueue:
    """First in, first out, from the loop to the writer."""

    def __init__(self, bound_bytes: int, waits: bool) -> None:
        """waits: whoever puts waits for room; nothing is left out."""
        self._bound, self._waits = bound_bytes, waits
        self._changed = Condition()
        self._waiting: deque[Waiting] = deque()
        self._held = self._pictures_left = self._others_left = 0
        self._closed = False

    def put(self, item: Recordable) -> None:
        """Let it in, or leave it out where there is no room or the queue is closed."""
        size, picture = item.size, item.picture
        with self._changed:
            if self._waits:
                self._changed.wait_for(lambda: self._closed or self._has_room(size, self._bound))
            if self._closed:
                return
            if self._has_room(size, self._bound * (1 if picture else BOUNDS_OF_OTHERS)):
                self._waiting.append(Waiting(item, size, self._pictures_left, self._others_left))
                self._held += size
                self._pictures_left = self._others_left = 0
                if (
                    self._waits or not picture
                ):  # a picture opens a round, in which the writer is to keep quiet
                    self._changed.notify_all()
            elif picture:
                self._pictures_left += 1
            else:
                self._others_left += 1

    def get(self) -> Waiting | None:
        """The oldest, waiting for one; None once the queue is closed and empty."""
        with self._changed:
            while not self._changed.wait_for(lambda: self._waiting or self._closed, PATIENCE_S):
                pass
            return self._waiting.popleft() if self._waiting else None

    def done(self, waiting: Waiting) -> None:
        """What was got is written: its bytes are free."""
        with self._changed:
            self._held -= waiting.size
            self._changed.notify_all()

    def close(self) -> tuple[int, int]:
        """Let nothing more in; how many pictures and others were left out since the last one let in."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
            return self._pictures_left, self._others_left

    def clear(self) -> None:
        """Forget what waits."""
        with self._changed:
            self._waiting.clear()

    def _has_room(self, size: int, bound: int) -> bool:
        return self._held == 0 or self._held + size <= bound
