"""Pictures in JPEG and PNG: colours by what is in them and by what their format says."""

from typing import Any

import cv2
import numpy as np
import pytest

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Image
from fieldnav.replay.foreign.compressed_image import compressed_picture, shows_its_colours

BLUE, GREEN, RED = 40, 120, 200
WIDTH, HEIGHT = 32, 16
CLOSE = 6
"""What JPEG changes of even colours."""


def flat(*channels: int, kind: Any = np.uint8) -> np.ndarray[Any, Any]:
    return np.full((HEIGHT, WIDTH, len(channels)), channels, kind)


def encoded(suffix: str, image: np.ndarray[Any, Any]) -> bytes:
    return cv2.imencode(suffix, image)[1].tobytes()


def is_the_scene(image: Image) -> bool:
    return image.dtype == np.uint8 and bool((abs(image.astype(int) - flat(BLUE, GREEN, RED)) < CLOSE).all())


@pytest.mark.parametrize(
    ("said", "data"),
    [
        ("jpeg", encoded(".jpg", flat(BLUE, GREEN, RED))),
        ("png", encoded(".png", flat(BLUE, GREEN, RED))),
        ("bgr8; jpeg compressed bgr8", encoded(".jpg", flat(BLUE, GREEN, RED))),
        ("rgb8; jpeg compressed bgr8", encoded(".jpg", flat(BLUE, GREEN, RED))),
        ("rgb8; jpeg compressed rgb8", encoded(".jpg", flat(RED, GREEN, BLUE))),
        ("yuv422; png compressed bgr8", encoded(".png", flat(BLUE, GREEN, RED))),
        ("bgra8; png compressed bgra8", encoded(".png", flat(BLUE, GREEN, RED, 9))),
        ("", encoded(".png", flat(BLUE << 8, GREEN << 8, RED << 8, kind=np.uint16))),
    ],
)
def test_colours_are_read_whatever_the_format_says_besides(said: str, data: bytes) -> None:
    assert is_the_scene(compressed_picture(data, said, "cam"))


@pytest.mark.parametrize("suffix", [".jpg", ".png"])
@pytest.mark.parametrize("said", ["bayer_rggb8; jpeg compressed ", "bayer_rggb8; png compressed bayer_rggb8"])
def test_a_bayer_pattern_gets_its_colours_by_its_format(said: str, suffix: str) -> None:
    mosaic = np.tile(np.array([[128, 100], [100, 90]], np.uint8), (HEIGHT // 2, WIDTH // 2))

    blue, green, red = compressed_picture(encoded(suffix, mosaic), said, "cam")[8, 8].tolist()

    assert abs(blue - 90) < 9 and abs(green - 100) < 9 and abs(red - 128) < 9
    assert not shows_its_colours(said)


def test_a_bayer_pattern_of_two_bytes_is_read() -> None:
    mosaic = np.tile(np.array([[RED, GREEN], [GREEN, BLUE]], np.uint16) << 8, (HEIGHT // 2, WIDTH // 2))

    assert is_the_scene(compressed_picture(encoded(".png", mosaic), "bayer_rggb16; png compressed ", "cam"))


@pytest.mark.parametrize(
    ("said", "image"),
    [
        ("mono8; jpeg compressed ", flat(GREEN)),
        ("yuv422_yuy2; jpeg compressed mono8", flat(GREEN)),
        ("jpeg", flat(GREEN)),
        ("mono16; png compressed mono16", flat(GREEN, kind=np.uint16)),
    ],
)
def test_a_picture_without_colour_is_refused(said: str, image: Any) -> None:
    suffix = ".png" if image.dtype == np.uint16 else ".jpg"

    with pytest.raises(
        DriverError, match=r"^cam: format '.*': is not in colour; allowed are JPEG and PNG"
    ) as no:
        compressed_picture(encoded(suffix, image), said, "cam")

    assert no.value.fault is FaultKind.CAMERA_SIZE


@pytest.mark.parametrize("share", [0.3, 0.6, 0.97])
@pytest.mark.parametrize("suffix", [".jpg", ".png"])
def test_a_half_written_picture_is_damaged(share: float, suffix: str) -> None:
    noise = np.random.default_rng(1).integers(0, 255, (64, 64, 3), np.uint8)
    data = encoded(suffix, noise)

    with pytest.raises(DriverError, match="cam: format 'jpeg': is cut off"):
        compressed_picture(data[: round(share * len(data))], "jpeg", "cam")


def test_a_preview_within_a_half_written_picture_does_not_make_it_whole() -> None:
    noise = np.random.default_rng(1).integers(0, 255, (64, 64, 3), np.uint8)
    preview, whole = encoded(".jpg", noise[:16, :16]), encoded(".jpg", noise)
    note = b"\xff\xe1" + (len(preview) + 2).to_bytes(2) + preview
    data = whole[:2] + note + whole[2:]

    compressed_picture(data, "jpeg", "cam")
    with pytest.raises(DriverError, match="is cut off"):
        compressed_picture(data[:-40], "jpeg", "cam")


def test_bytes_that_a_camera_pads_with_change_nothing() -> None:
    assert is_the_scene(
        compressed_picture(encoded(".jpg", flat(BLUE, GREEN, RED)) + bytes(64), "jpeg", "cam")
    )


@pytest.mark.parametrize("data", [b"", b"no picture"])
def test_what_is_no_picture_is_named(data: bytes) -> None:
    with pytest.raises(DriverError, match="cam: format 'h264': is no picture that can be read"):
        compressed_picture(data, "h264", "cam")
