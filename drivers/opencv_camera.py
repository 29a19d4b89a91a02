"""Cameras that OpenCV opens: a device, by its path or number, or what one has recorded."""

from collections.abc import Callable
from pathlib import Path
from threading import Event, Thread
from typing import Any, Protocol

import cv2
import numpy as np

from drivers.ports import Camera
from drivers.recorded_camera import PICTURES, Folder, RecordedCamera, Still, Video, check_size
from fieldnav.errors import DriverError
from fieldnav.messages import CameraName, Frame
from fieldnav.settings.camera import CameraSettings

CLOSING_S = 2.0
"""So long closing waits for a device that is about to give a frame; longer than any exposure."""


class Device(Protocol):
    """What a live camera needs of OpenCV's VideoCapture."""

    def read(self) -> tuple[bool, Any]:
        """Wait for the next frame; whether there is one, and the frame."""
        ...

    def release(self) -> None: ...


def open_camera(name: CameraName, settings: CameraSettings, clock: Callable[[], float]) -> Camera:
    """The camera of a robot file; `clock` is the one that the loop goes by.

    Raises DriverError, which names the source, when it cannot be opened.
    """
    source, path = settings.source, Path(settings.source)
    try:
        if path.is_dir():
            return RecordedCamera(name, settings, Folder(path))
        if path.is_file() and path.suffix.lower() in PICTURES:
            return RecordedCamera(name, settings, Still(path))
        if path.is_file():
            return RecordedCamera(name, settings, Video(_opened(source)))
        if path.is_fifo():
            raise DriverError(f"{source}: is a pipe, which would be waited for without end")
        if not source.isdecimal() and not path.exists():
            raise DriverError(f"{source}: there is no such device, video, picture or folder")
        return LiveCamera(name, settings, _tuned(_opened(source), settings), clock)
    except DriverError as error:
        raise DriverError(f"{name.value} camera: {error}") from error
    except OSError as error:
        raise DriverError(f"{name.value} camera: {source}: cannot be read: {error.strerror}") from error


def _opened(source: str) -> cv2.VideoCapture:
    """Raises DriverError; OpenCV's own words about it are kept quiet."""
    level = cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    try:
        capture = cv2.VideoCapture(int(source) if source.isdecimal() else source)
    finally:
        cv2.utils.logging.setLogLevel(level)
    if not capture.isOpened():
        raise DriverError(f"{source}: cannot be opened as a camera or a video")
    return capture


def _tuned(capture: cv2.VideoCapture, settings: CameraSettings) -> cv2.VideoCapture:
    """Ask a device for the robot file's size and rate; what it makes of that shows in its frames."""
    # Raw pictures of 1280x720 do not go through USB 2 at 15 a second.
    capture.set(cv2.CAP_PROP_FOURCC, cv2.VideoWriter.fourcc(*"MJPG"))
    capture.set(cv2.CAP_PROP_FRAME_WIDTH, settings.width_px)
    capture.set(cv2.CAP_PROP_FRAME_HEIGHT, settings.height_px)
    capture.set(cv2.CAP_PROP_FPS, settings.rate_hz)
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
    return capture


class LiveCamera:
    """The Camera port over a device: a thread takes every frame as it comes and keeps the newest alone.

    A frame's stamp is when it had come, by `clock`; it was exposed some tens of milliseconds before.
    """

    def __init__(
        self,
        name: CameraName,
        settings: CameraSettings,
        device: Device,
        clock: Callable[[], float],
    ) -> None:
        self._name, self._settings, self._device, self._clock = name, settings, device, clock
        self._newest: Frame | None = None
        self._failure = ""
        self._closing = Event()
        self._thread = Thread(target=self._take, name=f"{name.value} camera", daemon=True)
        self._thread.start()

    def latest(self, now_s: float) -> Frame | None:
        """The newest frame; it may have come since `now_s` was read, by less than the gate allows."""
        if self._failure:
            raise DriverError(f"{self._name.value} camera: {self._failure}")
        return self._newest

    def close(self) -> None:
        self._closing.set()
        self._thread.join(CLOSING_S)
        if not self._thread.is_alive():  # a device that hangs in a read may not be released under it
            self._device.release()

    def _take(self) -> None:
        sequence = 0
        try:
            while not self._closing.is_set():
                whole, image = self._device.read()
                stamp_s = self._clock()
                if not whole:
                    raise DriverError(f"{self._settings.source}: gives no more frames")
                sequence += 1
                taken = np.asarray(image, dtype=np.uint8)
                check_size(taken, self._settings)
                self._newest = Frame(self._name, sequence, stamp_s, taken)
        except (DriverError, cv2.error) as error:
            self._failure = str(error)
