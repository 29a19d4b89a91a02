"""One camera's pictures for those who watch: drawn in a thread of its own while somebody watches."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from threading import Condition, Event, Thread

import cv2

from drivers.ports import Camera
from fieldnav.messages import CameraName, Image

POLL_S = 0.005
"""Between two looks for a new exposure: the world's step."""
JPEG_QUALITY = 90
"""Of 100: what cameras compress to; below 80 thin leaves get lost among the squares."""
JPEG = ".jpg"


@dataclass(frozen=True, slots=True)
class Picture:
    """A compressed picture that leaves the camera at `due_s`; `stamp_s` is when it was exposed."""

    sequence: int
    stamp_s: float
    due_s: float
    jpeg: bytes


class PictureFeed:
    """Draws each exposure as soon as it is made and lets it go `latency_s` after it, as the camera would.

    `clock` is the world's time. The camera exposes in the thread of the world and draws in the feed's; all
    that the two share is its queue of exposures, whose single operations are atomic. Where it overflows
    between two of them the next exposure is drawn, which by then is old enough as well.
    """

    def __init__(
        self, name: CameraName, camera: Camera, latency_s: float, clock: Callable[[], float]
    ) -> None:
        self._camera, self._latency_s, self._clock = camera, latency_s, clock
        self._changed = Condition()
        self._pictures: list[Picture] = []
        self._watchers = 0
        self._closing = Event()
        self._thread = Thread(target=self._run, name=f"{name.value} camera's pictures", daemon=True)
        self._thread.start()

    @contextmanager
    def watching(self) -> Iterator[None]:
        """Pictures are drawn within this."""
        with self._changed:
            self._watchers += 1
            self._changed.notify_all()
        try:
            yield
        finally:
            with self._changed:
                self._watchers -= 1
                if not self._watchers:
                    self._pictures = []  # by the time somebody watches again these are old

    def newer_than(self, sequence: int) -> Picture | None:
        """Wait for the newest picture after that one; None when there will be no more."""
        with self._changed:
            while not self._closing.is_set():
                now_s = self._clock()
                gone_out = [picture for picture in self._pictures if picture.due_s <= now_s]
                if gone_out and gone_out[-1].sequence > sequence:
                    return gone_out[-1]
                coming = [picture.due_s - now_s for picture in self._pictures if picture.due_s > now_s]
                self._changed.wait(min(coming, default=None))
        return None

    def close(self) -> None:
        """Let everybody go who waits for a picture; a drawing that is under way is waited for."""
        self._end()
        self._thread.join()
        self._camera.close()

    def _end(self) -> None:
        with self._changed:
            self._closing.set()
            self._changed.notify_all()

    def _run(self) -> None:
        try:
            self._draw()
        finally:
            self._end()  # nobody shall wait for a thread that an error has ended

    def _draw(self) -> None:
        drawn = 0
        while self._is_watched():
            frame = self._camera.latest(self._clock() + self._latency_s)
            if frame is None or frame.sequence == drawn:
                self._closing.wait(POLL_S)
                continue
            drawn = frame.sequence
            self._put(
                Picture(drawn, frame.stamp_s, frame.stamp_s + self._latency_s, _compressed(frame.image))
            )

    def _is_watched(self) -> bool:
        """Waits for it; false at the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._watchers > 0 or self._closing.is_set())
            return not self._closing.is_set()

    def _put(self, picture: Picture) -> None:
        """Keep it and what still is to go out; of what has gone out the newest alone."""
        with self._changed:
            if not self._watchers:
                return
            now_s = self._clock()
            old = [each for each in self._pictures if each.due_s <= now_s]
            self._pictures = [*old[-1:], *self._pictures[len(old) :], picture]
            self._changed.notify_all()


def _compressed(image: Image) -> bytes:
    _, jpeg = cv2.imencode(JPEG, image, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    return jpeg.tobytes()
