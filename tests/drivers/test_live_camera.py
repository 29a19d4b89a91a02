"""A live camera: the newest frame with its age, never a queue; a source that is gone is opened again."""

import time
from collections.abc import Callable, Iterator
from itertools import count
from queue import Queue
from threading import Event
from threading import enumerate as running
from typing import TypeVar

import cv2
import numpy as np
import pytest

from drivers.live_camera import MAX_LATE_S, MAX_MISFITS, LiveCamera, Pauses
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame, Image
from fieldnav.settings.loading import load_robot

WIDTH_PX, HEIGHT_PX = 64, 48
LATENCY_S = 0.25
PATIENCE_S = 10.0
AT_ONCE, NEVER = Pauses(0.0, 0.0), Pauses(3600.0, 3600.0)
SETTINGS = load_robot("bonnbot").cameras.front.model_copy(
    update={
        "source": "http://eva:secret@camera/video",
        "width_px": WIDTH_PX,
        "height_px": HEIGHT_PX,
        "latency_s": LATENCY_S,
    }
)
Found = TypeVar("Found")
Read = Image | None | BaseException
"""What a read of a device comes to; None where there are no more frames."""


def grey(level: int) -> Image:
    return np.full((HEIGHT_PX, WIDTH_PX, 3), level, np.uint8)


class Webcam:
    """A device that gives what the test hands to it, and waits for it as a real one does."""

    def __init__(self) -> None:
        self.reads: Queue[Read] = Queue()
        self.released = Event()
        self.stamps_s = iter([0.0])
        """What its frames say of when they were made, one after another."""

    def own_stamp_s(self) -> float:
        return next(self.stamps_s)

    def read(self) -> tuple[bool, Image | None]:
        read = self.reads.get(timeout=PATIENCE_S)
        if isinstance(read, BaseException):
            raise read
        return read is not None, read

    def release(self) -> None:
        self.released.set()


class Port:
    """What webcams are plugged into, one after another, or a word of why there is none."""

    def __init__(self) -> None:
        self.webcams: list[Webcam] = []
        self.plugged: Queue[Webcam | DriverError] = Queue()
        self.first = self.plug_in()

    def plug_in(self) -> Webcam:
        """Another webcam, from which the next frames come."""
        webcam = Webcam()
        self.webcams.append(webcam)
        self.plugged.put(webcam)
        return webcam

    def open(self) -> Webcam:
        found = self.plugged.get(timeout=PATIENCE_S)
        if isinstance(found, DriverError):
            raise found
        return found


class Live:
    """A live camera on a port, and a clock that counts the frames."""

    def __init__(self, pauses: Pauses, own_stamp: Callable[[Webcam], float] | None = None) -> None:
        ticks, before = count(), set(running())
        self.port = Port()
        self.camera = LiveCamera(
            CameraName.FRONT,
            SETTINGS,
            self.port.open,
            lambda: float(next(ticks)),
            pauses,
            own_stamp=own_stamp,
        )
        (self.thread,) = set(running()) - before

    def newest(self, sequence: int) -> Frame:
        """The newest frame, once the thread has come so far."""

        def come() -> Frame | None:
            try:
                frame = self.camera.latest(0.0)
            except DriverError:
                return None
            return frame if frame is not None and frame.sequence >= sequence else None

        return until(come)

    def trouble(self) -> DriverError:
        """What the camera says, once it says anything."""

        def said() -> DriverError | None:
            try:
                self.camera.latest(0.0)
            except DriverError as error:
                return error
            return None

        return until(said)

    def end(self) -> None:
        """Close it; whoever waits for a frame or a webcam waits no longer."""
        for webcam in self.port.webcams:
            webcam.reads.put(None)
        self.port.plugged.put(DriverError("nothing is plugged in"))
        self.camera.close()


def until(look: Callable[[], Found | None]) -> Found:
    """What `look` finds in the end."""
    patient_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < patient_s:
        found = look()
        if found is not None:
            return found
    raise AssertionError("it never came")


@pytest.fixture
def live() -> Iterator[Live]:
    made = Live(AT_ONCE)
    yield made
    made.end()


@pytest.fixture
def waiting() -> Iterator[Live]:
    """A live camera that, once its source is gone, waits very long before it opens it again."""
    made = Live(NEVER)
    yield made
    made.end()


@pytest.fixture
def stamped() -> Iterator[Live]:
    """A live camera on a stream whose frames bring stamps of their own."""
    made = Live(AT_ONCE, Webcam.own_stamp_s)
    yield made
    made.end()


def test_before_its_first_frame_a_device_shows_nothing(live: Live) -> None:
    assert live.camera.latest(0.0) is None


def test_a_source_that_cannot_be_opened_at_the_start_is_an_error_at_once() -> None:
    port = Port()
    port.plugged.get()
    port.plugged.put(DriverError("no webcam", FaultKind.CAMERA_UNPLUGGED))

    with pytest.raises(DriverError, match="no webcam"):
        LiveCamera(CameraName.FRONT, SETTINGS, port.open, lambda: 0.0)


def test_only_the_newest_frame_is_kept_stamped_as_it_was_exposed(live: Live) -> None:
    for level in range(12):
        live.port.first.reads.put(grey(level))

    frame = live.newest(12)

    assert (frame.sequence, frame.image[0, 0, 0], frame.stamp_s) == (12, 11, 11 - LATENCY_S)
    assert live.camera.latest(99.0) is frame, "a device that is silent shows how old its frame is"


def test_a_frame_of_a_stream_that_was_held_up_is_as_old_as_its_own_stamp_says(stamped: Live) -> None:
    stamped.port.first.stamps_s = iter([70.0, 71.0, 71.5])
    for _ in range(3):
        stamped.port.first.reads.put(grey(0))

    frame = stamped.newest(3)

    assert frame.stamp_s == pytest.approx(2.0 - 0.5 - LATENCY_S, abs=0.01), "the third came at 2 s"


def test_a_stream_that_is_far_too_late_is_opened_again_and_counts_anew(stamped: Live) -> None:
    stamped.port.first.stamps_s = iter([0.0, 0.1, 0.2, 0.3])
    for _ in range(4):
        stamped.port.first.reads.put(grey(0))
    error = stamped.trouble()
    again = stamped.port.plug_in()
    again.stamps_s = iter([500.0])
    again.reads.put(grey(0))
    frame = stamped.newest(4)

    assert error.fault is FaultKind.CAMERA_UNPLUGGED
    assert f"come 2.7 s late by their own stamps, limit {MAX_LATE_S:.1f} s" in str(error)
    assert stamped.port.first.released.is_set()
    assert frame.stamp_s == pytest.approx(4.0 - LATENCY_S)


@pytest.mark.parametrize("how", [None, cv2.error("ioctl")])
def test_a_source_that_is_gone_is_a_fault_and_given_back(how: Read, waiting: Live) -> None:
    waiting.port.first.reads.put(grey(0))
    waiting.newest(1)

    waiting.port.first.reads.put(how)

    error = waiting.trouble()
    assert error.fault is FaultKind.CAMERA_UNPLUGGED
    assert str(error).startswith("front camera: http://***@camera/video: ")
    assert waiting.port.first.released.wait(PATIENCE_S)
    assert str(waiting.trouble()) == str(error), "for as long as it is gone"


def test_a_source_that_comes_back_is_seen_again_and_counted_on(live: Live) -> None:
    live.port.first.reads.put(grey(1))
    live.newest(1)
    live.port.first.reads.put(None)
    live.trouble()

    live.port.plugged.put(DriverError("still gone"))
    until(lambda: "still gone" in str(live.trouble()) or None)
    live.port.plug_in().reads.put(grey(2))

    frame = live.newest(2)
    assert (frame.sequence, frame.image[0, 0, 0]) == (2, 2)


def test_a_source_that_is_opened_again_stays_a_fault_until_its_first_frame(live: Live) -> None:
    live.port.first.reads.put(None)
    webcam = live.port.plug_in()
    until(lambda: live.port.plugged.empty() or None)

    assert live.trouble().fault is FaultKind.CAMERA_UNPLUGGED

    webcam.reads.put(grey(0))
    live.newest(1)


def test_pauses_grow_up_to_the_longest_and_begin_anew_after_a_frame() -> None:
    noted = []

    class Noted(Pauses):
        def after(self, pause_s: float) -> float:
            noted.append(pause_s)
            return super().after(pause_s)

    live = Live(Noted(first_s=0.001, longest_s=0.003))
    live.port.first.reads.put(None)
    for _ in range(3):
        live.port.plugged.put(DriverError("gone"))
    second = live.port.plug_in()
    second.reads.put(grey(0))
    live.newest(1)
    second.reads.put(None)
    live.trouble()
    live.port.plug_in().reads.put(grey(0))
    live.newest(2)
    live.end()

    assert noted[:5] == [0.001, 0.002, 0.003, 0.003, 0.001]


def test_a_frame_of_the_wrong_size_is_a_fault_until_a_right_one_comes(live: Live) -> None:
    live.port.first.reads.put(grey(0))
    live.newest(1)

    for _ in range(2):
        live.port.first.reads.put(np.zeros((720, 1280, 3), np.uint8))
        error = live.trouble()
        assert error.fault is FaultKind.CAMERA_SIZE
        assert "gives 1280x720 px; the robot file has width_px 64 and height_px 48" in str(error)

    live.port.first.reads.put(grey(0))
    assert live.newest(4).sequence == 4


def test_a_source_that_stays_of_the_wrong_size_is_opened_again_and_the_fault_stays_meanwhile(
    live: Live,
) -> None:
    for _ in range(MAX_MISFITS):
        live.port.first.reads.put(np.zeros((720, 1280, 3), np.uint8))
    assert live.port.first.released.wait(PATIENCE_S)
    assert live.trouble().fault is FaultKind.CAMERA_SIZE

    live.port.plug_in().reads.put(grey(0))

    assert live.newest(MAX_MISFITS + 1).sequence == MAX_MISFITS + 1


def test_frames_without_colours_are_a_fault(live: Live) -> None:
    live.port.first.reads.put(grey(0)[:, :, 0])

    assert "gives 64x48 px without colours" in str(live.trouble())


@pytest.mark.parametrize("error", [ValueError("a bug"), SystemExit("a way out")])
def test_a_thread_that_dies_is_an_error_and_gives_the_device_back(error: BaseException, live: Live) -> None:
    live.port.first.reads.put(grey(0))
    live.newest(1)

    live.port.first.reads.put(error)

    told = live.trouble()
    assert told.fault is FaultKind.PROGRAM
    assert f"its thread broke off: {type(error).__name__}: {error}" in str(told)
    assert live.port.first.released.is_set()


def test_closing_ends_the_thread_and_gives_the_device_back(live: Live) -> None:
    live.port.first.reads.put(grey(0))
    live.newest(1)
    live.port.first.reads.put(grey(0))

    live.camera.close()

    assert not live.thread.is_alive() and live.port.first.released.is_set()
    assert "is closed" in str(live.trouble())


def test_closing_ends_a_thread_that_waits_to_open_again(waiting: Live) -> None:
    waiting.port.first.reads.put(None)
    waiting.trouble()

    waiting.camera.close()

    assert not waiting.thread.is_alive()
