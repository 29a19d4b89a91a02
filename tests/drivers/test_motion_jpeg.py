"""Captures of JPEGs: undecoded where the device lets us, so that a damaged frame is told from a whole one."""

from typing import Any

import cv2
import numpy as np
import pytest

from drivers.camera_source import own_stamp_s
from drivers.motion_jpeg import MOTION_JPEG, MotionJpeg, checked
from fieldnav.errors import PictureError

PICTURE = np.random.default_rng(3).integers(0, 256, (48, 64, 3), np.uint8)
JPEG = np.frombuffer(cv2.imencode(".jpg", PICTURE)[1].tobytes(), np.uint8)
YUYV = cv2.VideoWriter.fourcc(*"YUYV")


class Device:
    """A webcam behind OpenCV: its frames come as pictures until it is asked for what is on the wire."""

    def __init__(self, fourcc: int, backend: str, obeys: bool = True) -> None:
        self._fourcc, self._backend, self._obeys = fourcc, backend, obeys
        self.wire = JPEG
        self.asked: list[tuple[int, float]] = []

    def get(self, name: int) -> float:
        return {cv2.CAP_PROP_FOURCC: float(self._fourcc), cv2.CAP_PROP_POS_MSEC: 1250.0}.get(name, 0.0)

    def set(self, name: int, value: float) -> bool:
        self.asked.append((name, value))
        return self._obeys

    def getBackendName(self) -> str:  # noqa: N802 - OpenCV's name
        return self._backend

    def read(self) -> tuple[bool, Any]:
        return True, self.wire[None] if self.asked and self._obeys else PICTURE

    def grab(self) -> bool:
        return True

    def retrieve(self) -> tuple[bool, Any]:
        return self.read()

    def release(self) -> None:
        """Nothing to give back."""


@pytest.mark.parametrize(
    ("backend", "asked"),
    [("V4L2", (cv2.CAP_PROP_CONVERT_RGB, 0)), ("FFMPEG", (cv2.CAP_PROP_FORMAT, -1))],
)
def test_a_device_of_jpegs_is_asked_for_them_undecoded(backend: str, asked: tuple[int, float]) -> None:
    device = Device(MOTION_JPEG, backend)
    capture = checked(device)

    whole, image = capture.read()

    assert whole and np.array_equal(image, cv2.imdecode(JPEG, cv2.IMREAD_COLOR))
    assert device.asked == [asked]


def test_a_stream_of_jpegs_still_tells_its_own_stamps() -> None:
    assert own_stamp_s(checked(Device(MOTION_JPEG, "FFMPEG"))) == 1.25


def test_a_damaged_frame_of_a_device_is_none() -> None:
    device = Device(MOTION_JPEG, "V4L2")
    capture = checked(device)
    device.wire = JPEG.copy()
    device.wire[len(JPEG) // 2 :][:100] = 0

    with pytest.raises(PictureError):
        capture.read()


def test_what_stands_in_a_buffer_behind_a_frame_is_no_damage() -> None:
    device = Device(MOTION_JPEG, "V4L2")
    capture = checked(device)
    device.wire = np.concatenate([JPEG, JPEG[-500:], np.zeros(1000, np.uint8)])

    assert np.array_equal(capture.read()[1], cv2.imdecode(JPEG, cv2.IMREAD_COLOR))


@pytest.mark.parametrize(
    "device",
    [Device(YUYV, "V4L2"), Device(MOTION_JPEG, "GSTREAMER"), Device(MOTION_JPEG, "V4L2", obeys=False)],
)
def test_a_device_that_gives_no_jpegs_is_left_as_it_is(device: Device) -> None:
    capture = checked(device)

    assert not isinstance(capture, MotionJpeg)
    assert np.array_equal(capture.read()[1], PICTURE)


def test_a_device_that_says_it_does_and_goes_on_decoding_is_taken_at_its_frames() -> None:
    capture = MotionJpeg(Device(MOTION_JPEG, "V4L2"))

    assert np.array_equal(capture.read()[1], PICTURE)
