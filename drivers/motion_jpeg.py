"""Captures that give JPEGs: each is decoded here, since OpenCV says nothing of a damaged one."""

from typing import Any, Protocol

import cv2

from drivers.jpeg import decoded_jpeg

MOTION_JPEG = cv2.VideoWriter.fourcc(*"MJPG")
UNDECODED = -1
COLOUR_DIMENSIONS = 3
"""Of an array that is a decoded picture; a JPEG's bytes stand in a row."""


class Capture(Protocol):
    """What is asked of OpenCV's VideoCapture."""

    def read(self) -> tuple[bool, Any]:
        """Wait for the next frame; whether there is one, and the frame. Raises PictureError."""
        ...

    def grab(self) -> bool: ...

    def retrieve(self) -> tuple[bool, Any]:
        """The frame that was grabbed. Raises PictureError for a damaged one; the next one may be whole."""
        ...

    def get(self, property: int, /) -> float:
        """A property of the stream, such as the stamp of the frame that was read last."""
        ...

    def release(self) -> None: ...


def checked(capture: cv2.VideoCapture) -> Capture:
    """The capture, before its first frame; where it gives JPEGs a damaged one is told from a whole one."""
    if int(capture.get(cv2.CAP_PROP_FOURCC)) != MOTION_JPEG:
        return capture
    match capture.getBackendName():
        case "FFMPEG":
            undecoded = capture.set(cv2.CAP_PROP_FORMAT, UNDECODED)
        case "V4L2":
            undecoded = capture.set(cv2.CAP_PROP_CONVERT_RGB, 0)
        case _:
            undecoded = False
    return MotionJpeg(capture) if undecoded else capture


class MotionJpeg:
    """A capture of JPEGs, which decodes them or says that they are damaged."""

    def __init__(self, capture: Capture) -> None:
        self._capture = capture

    def read(self) -> tuple[bool, Any]:
        return self._decoded(*self._capture.read())

    def grab(self) -> bool:
        return self._capture.grab()

    def retrieve(self) -> tuple[bool, Any]:
        return self._decoded(*self._capture.retrieve())

    def get(self, property: int, /) -> float:
        return self._capture.get(property)

    def release(self) -> None:
        self._capture.release()

    @staticmethod
    def _decoded(whole: bool, frame: Any) -> tuple[bool, Any]:
        if not whole or frame.ndim == COLOUR_DIMENSIONS:
            return whole, frame
        return True, decoded_jpeg(frame.tobytes())
