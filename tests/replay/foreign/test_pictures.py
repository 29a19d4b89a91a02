"""Pictures as others store them, and what a camera gives of them."""

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from fieldnav.errors import DriverError, SettingsError
from fieldnav.messages import CameraName, Image
from fieldnav.replay.foreign.camera import ForeignCamera
from fieldnav.replay.foreign.container import Written, stamped
from fieldnav.replay.foreign.raw_image import raw_picture
from fieldnav.replay.foreign.shot import NS_PER_S, Shot
from fieldnav.settings.loading import load_robot

BLUE, GREEN, RED = 40, 120, 200
WIDTH, HEIGHT, PADDING = 16, 8, 3
FRONT = load_robot("bonnbot").cameras.front


def message(encoding: str, pixels: np.ndarray[Any, Any], **changes: Any) -> SimpleNamespace:
    """A sensor_msgs/Image whose rows are padded."""
    padded = np.pad(pixels.reshape(HEIGHT, -1), ((0, 0), (0, PADDING)), constant_values=255)
    fields = {"width": WIDTH, "height": HEIGHT, "step": padded.shape[1], "data": padded.ravel()}
    return SimpleNamespace(encoding=encoding, **(fields | changes))


def flat(*channels: int) -> Image:
    return np.full((HEIGHT, WIDTH, len(channels)), channels, np.uint8)


@pytest.mark.parametrize(
    ("encoding", "pixels"),
    [
        ("bgr8", flat(BLUE, GREEN, RED)),
        ("8UC3", flat(BLUE, GREEN, RED)),
        ("rgb8", flat(RED, GREEN, BLUE)),
        ("bgra8", flat(BLUE, GREEN, RED, 9)),
        ("rgba8", flat(RED, GREEN, BLUE, 9)),
    ],
)
def test_every_order_of_channels_is_read(encoding: str, pixels: Image) -> None:
    assert (raw_picture(message(encoding, pixels), "cam") == flat(BLUE, GREEN, RED)).all()


@pytest.mark.parametrize(
    ("encoding", "square"),
    [
        ("bayer_rggb8", [[RED, GREEN], [GREEN, BLUE]]),
        ("bayer_bggr8", [[BLUE, GREEN], [GREEN, RED]]),
        ("bayer_gbrg8", [[GREEN, BLUE], [RED, GREEN]]),
        ("bayer_grbg8", [[GREEN, RED], [BLUE, GREEN]]),
    ],
)
def test_every_bayer_pattern_is_read(encoding: str, square: list[list[int]]) -> None:
    mosaic = np.tile(np.array(square, np.uint8), (HEIGHT // 2, WIDTH // 2))

    image = raw_picture(message(encoding, mosaic), "cam")

    assert (image == flat(BLUE, GREEN, RED)).all()


@pytest.mark.parametrize(
    ("encoding", "pair"),
    [("yuv422", (220, 100, 128, 100)), ("uyvy", (220, 100, 128, 100)), ("yuv422_yuy2", (100, 220, 100, 128))],
)
def test_pixels_that_share_their_colour_are_read(encoding: str, pair: tuple[int, ...]) -> None:
    pixels = np.tile(np.array(pair, np.uint8), HEIGHT * WIDTH // 2)

    blue, green, red = raw_picture(message(encoding, pixels), "cam")[2, 3].tolist()

    assert blue > 200 and green < 100 and 80 < red < 120


@pytest.mark.parametrize(("seconds", "expected_ns"), [(3, 3_000_000_007), (0, 5)])
def test_a_header_without_a_stamp_is_as_old_as_its_message(seconds: int, expected_ns: int) -> None:
    stamp = SimpleNamespace(sec=seconds, nanosec=7 if seconds else 0)
    content = SimpleNamespace(header=SimpleNamespace(stamp=stamp))

    (told,) = stamped(iter([Written(5, "sensor_msgs/msg/Image", content)]))

    assert told.stamp_ns == expected_ns


@pytest.mark.parametrize("changes", [{"step": 3}, {"height": 9}, {"width": 0}, {"height": 0}])
def test_a_head_that_does_not_fit_the_bytes_is_refused(changes: dict[str, int]) -> None:
    with pytest.raises(DriverError, match=r"^cam: .*does not fit its"):
        raw_picture(message("bgr8", flat(1, 2, 3), **changes), "cam")


def shots(*stamps_s: float, size: tuple[int, int] = (FRONT.width_px, FRONT.height_px)) -> Iterator[Shot]:
    image = np.zeros((size[1], size[0], 3), np.uint8)
    stamps_ns = [round(each * NS_PER_S) for each in stamps_s]
    return iter([Shot("cam", each, each, lambda: image, b"jpeg") for each in stamps_ns])


def camera(**given: Any) -> Callable[..., ForeignCamera]:
    return lambda *stamps_s: ForeignCamera(CameraName.FRONT, FRONT, shots(*stamps_s, **given))


def test_a_camera_gives_the_newest_picture_of_its_time() -> None:
    seen = camera()(10.0, 10.1, 10.2, 10.5)
    begun_ns = seen.next.stamp_ns

    seen.advance(0.3, begun_ns)
    frame = seen.latest(0.3)

    assert frame is not None and frame.stamp_s == pytest.approx(0.2) and frame.sequence == 3
    assert frame.jpeg == b"jpeg" and seen.latest(0.3) is frame and not seen.ended


def test_a_picture_that_comes_too_late_is_passed_over() -> None:
    seen = camera()(10.0, 10.2, 10.1)

    seen.advance(1.0, seen.next.stamp_ns)
    frame = seen.latest(1.0)

    assert frame is not None and frame.stamp_s == pytest.approx(0.2) and frame.sequence == 2
    assert seen.ended and seen.counts.late == seen.counts.not_looked_at == 1


def test_pictures_of_another_size_are_scaled_and_it_is_said() -> None:
    seen = camera(size=(640, 360))(0.0)

    seen.advance(0.0, 0)
    frame = seen.latest(0.0)

    assert frame is not None and frame.image.shape == (720, 1280, 3) and frame.jpeg is None
    assert "front camera: 640x360 px scaled to 1280x720 px" in seen.notes


def test_a_camera_without_any_picture_is_refused() -> None:
    with pytest.raises(SettingsError, match="--front: there is no picture in it"):
        camera()()
