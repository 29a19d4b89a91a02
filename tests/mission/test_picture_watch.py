"""A picture that shows nothing is not gone by, and the reason says what it shows instead."""

from math import radians, tan

import numpy as np
import pytest

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import CameraName, Frame, Image
from fieldnav.mission.frame_rate import KEPT, FrameRate
from fieldnav.mission.picture_watch import BLACK, FROZEN_M, FROZEN_S, WHITE, PictureWatch
from fieldnav.odometry import Pose
from fieldnav.pinhole import Pinhole

CAMERA = Pinhole(640, 360, 320 / tan(radians(69) / 2), 1.0, radians(65), 0.75)
RATE_HZ = 15.0
PIXEL: Image = np.zeros((1, 1, 3), np.uint8)


def grey(level: float, noise: float = 3.0, seed: int = 0, shape: tuple[int, int] = (360, 640)) -> Image:
    """A picture of one grey, and a sensor's noise."""
    random = np.random.default_rng(seed)
    return np.clip(random.normal(level, noise, (*shape, 3)), 0, 255).astype(np.uint8)


def frame(image: Image, number: int = 1, camera: CameraName = CameraName.FRONT) -> Frame:
    return Frame(camera, number, number / RATE_HZ, image)


@pytest.mark.parametrize(
    ("level", "fault"),
    [
        (0, FaultKind.CAMERA_BLACK),
        (BLACK - 4, FaultKind.CAMERA_BLACK),
        (WHITE + 4, FaultKind.CAMERA_WHITE),
        (255, FaultKind.CAMERA_WHITE),
    ],
)
def test_a_black_or_white_picture_is_refused_and_says_how_bright_it_is(
    level: float, fault: FaultKind
) -> None:
    found = PictureWatch(CAMERA).objection(frame(grey(level)), Pose())
    assert found is not None
    assert found.fault is fault
    assert "front camera: brightness" in found.said


@pytest.mark.parametrize("level", [BLACK + 4, 60, 128, 200, WHITE - 4])
def test_a_dim_or_a_bright_picture_is_gone_by(level: float) -> None:
    assert PictureWatch(CAMERA).objection(frame(grey(level)), Pose()) is None


@pytest.mark.parametrize("shape", [(180, 320), (360, 320), (720, 1280), (640, 360)])
def test_a_picture_of_the_wrong_size_is_an_error_with_both_sizes(shape: tuple[int, int]) -> None:
    with pytest.raises(DriverError, match=f"gives {shape[1]}x{shape[0]}, its file says 640x360") as caught:
        PictureWatch(CAMERA).objection(frame(grey(90, shape=shape)), Pose())
    assert caught.value.fault is FaultKind.CAMERA_SIZE


def drive(watch: PictureWatch, pictures: list[Image], step_m: float, sideways: bool = False) -> list[Trouble]:
    """What is said of frame after frame, each taken a step further on."""
    said = []
    for number, image in enumerate(pictures):
        here_m = number * step_m
        pose = Pose(0.0, here_m, 0.0) if sideways else Pose(here_m, 0.0, 0.0)
        said.append(watch.objection(frame(image, number), pose))
    return [each for each in said if each is not None]


@pytest.mark.parametrize("sideways", [False, True])
def test_the_same_picture_is_found_out_as_soon_as_the_robot_has_moved(sideways: bool) -> None:
    step_m = FROZEN_M * 0.4
    assert not drive(PictureWatch(CAMERA), [grey(90)] * 3, step_m, sideways), "not before"
    found = drive(PictureWatch(CAMERA), [grey(90)] * 5, step_m, sideways)
    assert [each.fault for each in found] == [FaultKind.CAMERA_FROZEN] * 2
    assert "the same picture for" in found[0].said


def test_the_same_picture_is_found_out_also_where_the_robot_stands() -> None:
    frames = round(FROZEN_S * RATE_HZ)
    assert not drive(PictureWatch(CAMERA), [grey(90)] * frames, 0.0), "not before"
    assert drive(PictureWatch(CAMERA), [grey(90)] * (frames + 3), 0.0)[0].fault is FaultKind.CAMERA_FROZEN


def test_pictures_that_differ_by_noise_alone_are_no_frozen_ones() -> None:
    pictures = [grey(90, noise=1.0, seed=seed) for seed in range(12)]
    assert not drive(PictureWatch(CAMERA), pictures, 0.0)
    assert not drive(PictureWatch(CAMERA), pictures, 2 * FROZEN_M)


def test_a_camera_that_shows_something_new_again_is_gone_by_again() -> None:
    watch = PictureWatch(CAMERA)
    assert drive(watch, [grey(90)] * 5, FROZEN_M)
    assert watch.objection(frame(grey(90, seed=7), 6), Pose(1.0, 0.0, 0.0)) is None


def rated(rate_hz: float, frames: int = 2 * KEPT, skipped: int = 0) -> FrameRate:
    """A camera of RATE_HZ that gives so many frames a second, of which so many are not looked at."""
    watching = FrameRate(RATE_HZ)
    for number in range(0, frames * (1 + skipped), 1 + skipped):
        watching.add(Frame(CameraName.FRONT, number, number / rate_hz, PIXEL))
    return watching


@pytest.mark.parametrize("rate_hz", [RATE_HZ, 12.0, RATE_HZ / 2])
def test_a_camera_of_more_than_half_its_rate_does_not_slow_the_robot(rate_hz: float) -> None:
    assert rated(rate_hz).share == 1.0


@pytest.mark.parametrize(("rate_hz", "share"), [(5.0, 2 / 3), (3.0, 0.4), (1.5, 0.2)])
def test_a_slow_camera_slows_the_robot_in_proportion_and_says_its_rate(rate_hz: float, share: float) -> None:
    watching = rated(rate_hz)
    assert watching.share == pytest.approx(share)
    assert watching.said == f"{rate_hz:.1f} frames a second, its file says 15"


def test_frames_that_nobody_looked_at_do_not_make_a_camera_slow() -> None:
    assert rated(RATE_HZ, skipped=3).share == 1.0


def test_one_lost_frame_does_not_make_a_camera_slow() -> None:
    watching = rated(RATE_HZ)
    for number in (15, 16, 20, 21):
        watching.add(Frame(CameraName.FRONT, number, number / RATE_HZ, PIXEL))
    assert watching.share == 1.0


def test_nothing_is_said_before_enough_frames_have_come() -> None:
    assert rated(3.0, frames=KEPT).share == 1.0
