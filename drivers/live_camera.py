"""A live camera: a thread takes every frame as it comes, and opens the source again when it fails."""

from collections.abc import Callable
from dataclasses import dataclass
from threading import Event, Thread
from typing import Any, Protocol

import cv2
import numpy as np

from drivers.compression import compressed
from drivers.recorded_camera import check_size
from drivers.stream_clock import StreamClock
from fieldnav.errors import DriverError, PictureError
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import CameraName, Frame
from fieldnav.settings.camera import CameraSettings
from fieldnav.settings.shown_source import shown

CLOSING_S = 3.0
"""So long closing waits for a source that is about to give a frame; longer than OpenCV waits for one."""
MAX_MISFITS = 15
"""Pictures of the wrong size in a row, a second's, after which the source is opened again: OpenCV scales all
pictures of a stream to the size of its first, and would never show that the stream is right again."""
MAX_LATE_S = 2.0
"""A stream that is so late is opened again, which leaves behind what waits; as one that gives nothing."""


class Device(Protocol):
    """What a live camera needs of OpenCV's VideoCapture."""

    def read(self) -> tuple[bool, Any]:
        """Wait for the next frame; whether there is one, and the frame. Raises PictureError where damaged."""
        ...

    def release(self) -> None: ...


@dataclass(frozen=True, slots=True)
class Pauses:
    """Between attempts to open a source again: each is twice the one before, up to the longest."""

    first_s: float = 0.5
    longest_s: float = 5.0

    def after(self, pause_s: float) -> float:
        """The pause that follows one of `pause_s` when nothing has come of it."""
        return min(2 * pause_s, self.longest_s)


PAUSES = Pauses()


class LiveCamera:
    """The Camera port over a device that `opener` opens: the newest frame alone is kept.

    A frame's stamp is when it had come, by `clock`, less `latency_s` of the settings; a stream whose frames
    have stamps of their own is told late from punctual by them. The constructor raises what `opener` raises,
    a DriverError; later the source is opened again for as long as it takes.
    """

    def __init__(
        self,
        name: CameraName,
        settings: CameraSettings,
        opener: Callable[[], Device],
        clock: Callable[[], float],
        pauses: Pauses = PAUSES,
        quality: int | None = None,
        own_stamp: Callable[[Any], float] | None = None,
    ) -> None:
        """quality: of the JPEG that each frame is to come with, made on this camera's thread.

        own_stamp: reads from a device the stamp, in seconds, that its last frame brought itself.
        """
        self._quality, self._own_stamp = quality, own_stamp
        self._name, self._settings, self._clock, self._pauses = name, settings, clock, pauses
        self._opener, self._source = opener, shown(settings.source)
        self._newest: Frame | Trouble | None = None  # one value, so that a reader never sees half of a change
        self._sequence = self._misfits = 0
        self._closing = Event()
        self._thread = Thread(target=self._run, args=(opener(),), name=f"{name.value} camera", daemon=True)
        self._thread.start()

    def latest(self, now_s: float) -> Frame | None:
        """The newest frame; it may have come since `now_s` was read, by less than the gate allows.

        Raises DriverError, its fault CAMERA_UNPLUGGED, CAMERA_SIZE or PROGRAM, until the next good frame.
        """
        alive, newest = self._thread.is_alive(), self._newest  # in this order: the last it does is to say why
        if not alive and not isinstance(newest, Trouble):
            newest = Trouble(FaultKind.PROGRAM, f"{self._source}: is closed")
        if isinstance(newest, Trouble):
            raise DriverError(f"{self._name.value} camera: {newest.said}", newest.fault)
        return newest

    def close(self) -> None:
        """End the thread, which gives the device back; one that a device holds up ends once it is let go."""
        self._closing.set()
        self._thread.join(CLOSING_S)

    def _run(self, device: Device) -> None:
        try:
            self._attend(device)
        except BaseException as error:  # a thread has nobody above it to tell
            said = f"{self._source}: its thread broke off: {type(error).__name__}: {error}"
            self._newest = Trouble(FaultKind.PROGRAM, said)

    def _attend(self, device: Device | None) -> None:
        """Take frames; when no more come open the source again after a pause, until closed."""
        pause_s = self._pauses.first_s
        while True:
            before = self._sequence
            if device is not None:
                self._take_all(device)
            if self._sequence > before:
                pause_s = self._pauses.first_s
            if self._closing.wait(pause_s):
                return
            pause_s = self._pauses.after(pause_s)
            device = self._opened_again()

    def _take_all(self, device: Device) -> None:
        """Take frames until there are no more that fit or the camera is closed, and give the device back."""
        stream = StreamClock()
        try:
            while not self._closing.is_set():
                try:
                    whole, image = device.read()
                except PictureError as error:
                    self._pass_over(error)
                    continue
                if not whole:
                    raise DriverError(f"{self._source}: gives no more frames", FaultKind.CAMERA_UNPLUGGED)
                self._take(image, self._punctual_s(device, stream))
        except (DriverError, cv2.error) as error:
            self._fail(error)
        finally:
            device.release()

    def _pass_over(self, error: PictureError) -> None:
        """A damaged frame is none: said until the next whole one comes, which is as a rule at once."""
        self._sequence += 1
        self._newest = Trouble(FaultKind.CAMERA_UNPLUGGED, f"{self._source}: a frame {error}")

    def _punctual_s(self, device: Device, stream: StreamClock) -> float:
        """When the frame that was just read has arrived, or should have. Raises DriverError if long ago."""
        arrived_s = self._clock()
        if self._own_stamp is None:
            return arrived_s
        punctual_s = stream.punctual_s(self._own_stamp(device), arrived_s)
        late_s = arrived_s - punctual_s
        if late_s > MAX_LATE_S:
            said = f"its frames come {late_s:.1f} s late by their own stamps, limit {MAX_LATE_S:.1f} s"
            raise DriverError(f"{self._source}: {said}", FaultKind.CAMERA_UNPLUGGED)
        return punctual_s

    def _take(self, image: Any, punctual_s: float) -> None:
        self._sequence += 1
        taken, stamp_s = np.asarray(image, dtype=np.uint8), punctual_s - self._settings.latency_s
        try:
            check_size(taken, self._settings)
        except DriverError as error:
            self._misfits += 1
            self._newest = Trouble(error.fault, str(error))
            if self._misfits % MAX_MISFITS == 0:
                raise
        else:
            self._misfits = 0
            frame = Frame(self._name, self._sequence, stamp_s, taken)
            self._newest = frame if self._quality is None else compressed(frame, self._quality)

    def _opened_again(self) -> Device | None:
        try:
            return self._opener()
        except (DriverError, cv2.error) as error:
            self._fail(error)
            return None

    def _fail(self, error: Exception) -> None:
        if isinstance(error, DriverError) and error.fault is FaultKind.CAMERA_SIZE:
            return  # it has been told, and is to be told until it is mended
        said = str(error) if isinstance(error, DriverError) else f"{self._source}: cannot be read"
        self._newest = Trouble(FaultKind.CAMERA_UNPLUGGED, f"{said}; it is opened again and again")
