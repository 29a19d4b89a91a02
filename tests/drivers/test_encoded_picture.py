"""Pictures that are damaged: none is given out as if it were whole, and no decoder says a word of its own."""

from collections.abc import Callable
from typing import cast

import cv2
import numpy as np
import pytest

from drivers.encoded_picture import decoded_picture
from fieldnav.errors import PictureError
from fieldnav.messages import Image

HEIGHT_PX, WIDTH_PX = 240, 320
HOLE = bytes(2000)
Damage = Callable[[bytes], bytes]


def scene() -> Image:
    """Grain, so that every part of the picture takes its share of the file."""
    rng = np.random.default_rng(7)
    return cast(Image, cv2.GaussianBlur(rng.integers(0, 256, (HEIGHT_PX, WIDTH_PX, 3), np.uint8), (5, 5), 0))


def encoded(suffix: str, *options: int) -> bytes:
    return cv2.imencode(suffix, scene(), options)[1].tobytes()


def with_hole(content: bytes) -> bytes:
    middle = len(content) // 2
    return content[:middle] + HOLE + content[middle + len(HOLE) :]


def cut(content: bytes) -> bytes:
    return content[: len(content) // 2]


def without_end(content: bytes) -> bytes:
    return content[:-40]


def flipped(content: bytes) -> bytes:
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 0x10]) + content[middle + 1 :]


PROGRESSIVE = (cv2.IMWRITE_JPEG_PROGRESSIVE, 1)
RESTARTING = (cv2.IMWRITE_JPEG_RST_INTERVAL, 4)
LZW = (cv2.IMWRITE_TIFF_COMPRESSION, 5)


@pytest.mark.parametrize("damage", [with_hole, cut, without_end])
@pytest.mark.parametrize(
    ("suffix", "options"),
    [
        (".jpg", ()),
        (".jpg", PROGRESSIVE),
        (".jpg", RESTARTING),
        (".png", ()),
        (".tiff", LZW),
    ],
)
def test_a_damaged_picture_is_none_and_only_fieldnav_says_so(
    suffix: str, options: tuple[int, ...], damage: Damage, capfd: pytest.CaptureFixture[str]
) -> None:
    content = encoded(suffix, *options)
    assert decoded_picture(content).shape == (HEIGHT_PX, WIDTH_PX, 3)

    with pytest.raises(PictureError, match="is no whole picture"):
        decoded_picture(damage(content))

    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("suffix", [".bmp", ".webp"])
def test_a_picture_that_is_cut_is_none_where_only_its_length_tells(
    suffix: str, capfd: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(PictureError):
        decoded_picture(cut(encoded(suffix)))

    assert capfd.readouterr().err == ""


def test_one_wrong_bit_in_a_png_is_found() -> None:
    with pytest.raises(PictureError):
        decoded_picture(flipped(encoded(".png")))


def test_zeros_that_decode_as_by_chance_into_as_many_blocks_are_found() -> None:
    content = encoded(".jpg", cv2.IMWRITE_JPEG_QUALITY, 97)

    for share in np.linspace(0.2, 0.8, 25):
        at = int(share * len(content))
        with pytest.raises(PictureError):
            decoded_picture(content[:at] + bytes(128) + content[at + 128 :])


@pytest.mark.parametrize("optimised", [0, 1])
@pytest.mark.parametrize("level", [0, 128, 255])
def test_a_picture_of_one_colour_has_no_hole(level: int, optimised: int) -> None:
    plain = np.full((1080, 1920, 3), level, np.uint8)
    jpeg = cv2.imencode(".jpg", plain, (cv2.IMWRITE_JPEG_OPTIMIZE, optimised))[1].tobytes()

    assert decoded_picture(jpeg).mean() == pytest.approx(level, abs=1)


def test_zeros_behind_the_end_of_a_picture_are_no_damage() -> None:
    assert decoded_picture(encoded(".jpg") + bytes(500)).shape == (HEIGHT_PX, WIDTH_PX, 3)


def test_a_picture_is_turned_as_its_exif_says() -> None:
    orientation = bytes.fromhex(
        "ffe1 0022 457869660000 4d4d002a00000008 0001 0112 0003 00000001 0006 0000 00000000"
    )
    jpeg = encoded(".jpg")

    assert decoded_picture(jpeg[:2] + orientation + jpeg[2:]).shape == (WIDTH_PX, HEIGHT_PX, 3)


def test_a_head_that_claims_more_pixels_than_a_camera_has_takes_no_memory() -> None:
    jpeg = bytearray(encoded(".jpg"))
    size = jpeg.index(b"\xff\xc0") + 5
    jpeg[size : size + 4] = b"\xff\xff\xff\xff"

    with pytest.raises(PictureError):
        decoded_picture(bytes(jpeg))


@pytest.mark.parametrize("content", [b"", b"\xff\xd8", b"\xff\xd8\xff\xda", b"no picture"])
def test_what_is_no_picture_is_none(content: bytes) -> None:
    with pytest.raises(PictureError):
        decoded_picture(content)
