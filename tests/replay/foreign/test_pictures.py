"""Pictures as others store them, and what a camera gives of them."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from fieldnav.errors import DriverError, SettingsError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Image
from fieldnav.replay.foreign.camera import ForeignCamera
from fieldnav.replay.foreign.container import Written, stamped
from fieldnav.replay.foreign.left_out import LeftOut
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


def broken() -> Image:
    raise DriverError("cam: is cut off", FaultKind.CAMERA_UNPLUGGED)


def with_broken(*numbers: int) -> Iterator[Shot]:
    """Ten pictures at 10 Hz, counted from 1, some of them broken."""
    return (
        replace(shot, picture=broken) if number in numbers else shot
        for number, shot in enumerate(shots(*(each / 10 for each in range(10))), 1)
    )


@pytest.mark.parametrize("numbers", [(1,), (1, 2), (4, 7, 8)])
def test_damaged_pictures_are_left_out_counted_and_told(numbers: tuple[int, ...]) -> None:
    seen = ForeignCamera(CameraName.FRONT, FRONT, with_broken(*numbers), 10)
    given = set()

    for tick in range(60):
        seen.advance(tick / 50, 0)
        frame = seen.latest(tick / 50)
        given.add(None if frame is None else round(frame.stamp_s * 10) + 1)

    assert given - {None} == set(range(1, 11)) - set(numbers)
    assert seen.counts.damaged == seen.counts.not_looked_at == len(numbers)
    assert f"front camera: picture {numbers[0]} is damaged: cam: is cut off" in seen.notes
    (said,) = LeftOut([seen], again=False, finished=False).said
    assert said == (f"front camera: {len(numbers)} of 10 pictures were not looked at: {len(numbers)} damaged")


def test_pictures_that_are_all_damaged_are_refused() -> None:
    with pytest.raises(SettingsError, match="cam: is cut off"):
        ForeignCamera(CameraName.FRONT, FRONT, with_broken(*range(1, 11)), 10)


def test_pictures_that_newer_ones_overtake_within_a_round_are_told_and_are_no_failure() -> None:
    seen = camera()(*(each / 100 for each in range(50)))
    for tick in range(60):
        seen.advance(tick / 50, 0)

    left_out = LeftOut([seen], again=False, finished=False)

    assert seen.counts.overtaken in (24, 25) and not left_out.much
    assert "of 50 pictures were overtaken by newer ones within 0.02 s" in left_out.said[0]


def test_what_a_file_tells_of_and_does_not_hold_is_counted() -> None:
    seen = ForeignCamera(CameraName.FRONT, FRONT, shots(0.0, 0.1), 10)
    seen.advance(0.0, 0)
    seen.advance(1.0, 0)

    left_out = LeftOut([seen], again=False, finished=True)

    assert left_out.much
    assert left_out.said == [
        "front camera: 8 of 10 pictures were not looked at: 8 that the file tells of and does not hold"
    ]


def test_the_number_that_a_video_tells_may_be_a_little_off() -> None:
    seen = ForeignCamera(CameraName.FRONT, FRONT, shots(0.0, 0.1), 4, 2)
    seen.advance(0.0, 0)
    seen.advance(1.0, 0)

    assert LeftOut([seen], again=False, finished=False).said == []


def test_after_a_mission_that_finished_there_is_nothing_left_to_look_at() -> None:
    seen = ForeignCamera(CameraName.FRONT, FRONT, shots(*range(100)), 100)
    seen.advance(9.0, 0)

    finished, stopped = (LeftOut([seen], again=False, finished=each) for each in (True, False))

    assert not finished.much and stopped.much
    assert "90 after the mission had finished (see --lanes, --again)" in finished.said[0]
    assert "90 after the mission had stopped (see --again)" in stopped.said[0]


def test_pictures_of_another_size_are_scaled_and_it_is_said() -> None:
    seen = camera(size=(640, 360))(0.0)

    seen.advance(0.0, 0)
    frame = seen.latest(0.0)

    assert frame is not None and frame.image.shape == (720, 1280, 3) and frame.jpeg is None
    assert "front camera: 640x360 px scaled to 1280x720 px" in seen.notes


def test_a_camera_without_any_picture_is_refused() -> None:
    with pytest.raises(SettingsError, match="--front: there is no picture in it"):
        camera()()
