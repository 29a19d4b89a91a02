"""A picture that shows nothing is not gone by, and the reason says what it shows instead."""

from math import radians, tan

import numpy as np
import pytest

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import CameraName, Frame, Image
from fieldnav.mission.frame_rate import KEPT, FrameRate
from fieldnav.mission.picture_watch import (
    BLACK,
    COLOUR_LEVELS,
    COLOURED_SHARE,
    FROZEN_M,
    FROZEN_S,
    WHITE,
    PictureWatch,
)
from fieldnav.odometry import Pose, Track
from fieldnav.pinhole import Pinhole

CAMERA = Pinhole(640, 360, 320 / tan(radians(69) / 2), 1.0, radians(65), 0.75)
RATE_HZ, MAX_DELAY_S = 15.0, 0.5
CLODS = 3.0
"""Grey levels, standard deviation; the smoothest soil in photographs has twice as much."""
PIXEL: Image = np.zeros((1, 1, 3), np.uint8)


def grey(level: float, noise: float = 3.0, seed: int = 0, shape: tuple[int, int] = (360, 640)) -> Image:
    """Soil of one grey: clods, the same for every seed, under a sensor's noise."""
    clods = np.random.default_rng(0).normal(0, CLODS, (shape[0] // 20, shape[1] // 20, 1))
    soil = level + np.kron(clods, np.ones((20, 20, 1)))
    random = np.random.default_rng(seed)
    return np.clip(soil + random.normal(0, noise, (*shape, 3)), 0, 255).astype(np.uint8)


def frame(image: Image, number: int = 1, camera: CameraName = CameraName.FRONT) -> Frame:
    return Frame(camera, number, number / RATE_HZ, image)


def watching() -> PictureWatch:
    return PictureWatch(CAMERA, MAX_DELAY_S)


def track_of(*poses: Pose) -> Track:
    """Where the robot was at each of the frames, from number 0 on."""
    track = Track(1000)
    for number, pose in enumerate(poses or (Pose(),)):
        track.add(number / RATE_HZ, pose)
    return track


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
    found = watching().objection(frame(grey(level)), track_of())
    assert found is not None
    assert found.fault is fault
    assert "front camera: brightness" in found.said


@pytest.mark.parametrize("level", [BLACK + 4, 60, 128, 200, WHITE - 4])
def test_a_dim_or_a_bright_picture_is_gone_by(level: float) -> None:
    assert watching().objection(frame(grey(level)), track_of()) is None


@pytest.mark.parametrize("shape", [(180, 320), (360, 320), (720, 1280), (640, 360)])
def test_a_picture_of_the_wrong_size_is_an_error_with_both_sizes(shape: tuple[int, int]) -> None:
    with pytest.raises(DriverError, match=f"gives {shape[1]}x{shape[0]}, its file says 640x360") as caught:
        watching().objection(frame(grey(90, shape=shape)), track_of())
    assert caught.value.fault is FaultKind.CAMERA_SIZE


def drive(watch: PictureWatch, pictures: list[Image], step_m: float, sideways: bool = False) -> list[Trouble]:
    """What is said of frame after frame, each taken a step further on."""
    places = [number * step_m for number in range(len(pictures))]
    track = track_of(*(Pose(0.0, here_m) if sideways else Pose(here_m) for here_m in places))
    said = [watch.objection(frame(image, number), track) for number, image in enumerate(pictures)]
    return [each for each in said if each is not None]


@pytest.mark.parametrize("sideways", [False, True])
def test_the_same_picture_is_found_out_as_soon_as_the_robot_has_moved(sideways: bool) -> None:
    step_m = FROZEN_M * 0.4
    assert not drive(watching(), [grey(90)] * 3, step_m, sideways), "not before"
    found = drive(watching(), [grey(90)] * 5, step_m, sideways)
    assert [each.fault for each in found] == [FaultKind.CAMERA_FROZEN] * 2
    assert "the same picture for" in found[0].said


def test_the_same_picture_is_found_out_also_where_the_robot_stands() -> None:
    frames = round(FROZEN_S * RATE_HZ)
    assert not drive(watching(), [grey(90)] * frames, 0.0), "not before"
    assert drive(watching(), [grey(90)] * (frames + 3), 0.0)[0].fault is FaultKind.CAMERA_FROZEN


def test_pictures_that_differ_by_noise_alone_are_no_frozen_ones() -> None:
    pictures = [grey(90, noise=1.0, seed=seed) for seed in range(12)]
    for image in pictures:
        image[..., 2] += 20  # soil has a colour
    assert not drive(watching(), pictures, 0.0)
    assert not drive(watching(), pictures, 2 * FROZEN_M)


def test_a_camera_that_shows_something_new_again_is_gone_by_again() -> None:
    watch = watching()
    assert drive(watch, [grey(90)] * 5, FROZEN_M)
    assert watch.objection(frame(grey(90, seed=7), 6), track_of(*[Pose(1.0)] * 7)) is None


def with_clock(rows: int, pictures: int = 8) -> list[Image]:
    """The same picture, but for so many rows of it."""
    made = [grey(90) for _ in range(pictures)]
    for number, image in enumerate(made):
        image[:rows] = grey(90, 30.0, number)[:rows]
    return made


def test_a_picture_that_stands_while_a_clock_runs_in_it_is_the_same_picture() -> None:
    said = drive(watching(), with_clock(rows=24), FROZEN_M)
    assert {each.fault for each in said} == {FaultKind.CAMERA_FROZEN}
    assert "the same picture, but for 7% of it, for 0.20 s and 0.06 m" in said[0].said


def test_two_pictures_that_are_nearly_the_same_are_chance() -> None:
    others = [grey(90, 30.0, seed) for seed in range(50, 54)]
    assert not drive(watching(), [*with_clock(rows=24, pictures=2), *others], 0.04)


def test_a_picture_of_which_more_changes_is_left_to_be_held_against_the_motion() -> None:
    assert not drive(watching(), with_clock(rows=48), FROZEN_M)


def test_a_clock_that_runs_while_the_robot_stands_is_no_fault() -> None:
    """A camera that leaves noise out shows the same for as long as nothing moves."""
    assert not drive(watching(), with_clock(rows=8, pictures=100), 0.0)


def coloured(levels: float, share: float = 1.0) -> Image:
    """A grey picture in which a share of the pixels have a colour."""
    image = np.repeat(grey(90)[:, :, :1], 3, axis=2)
    reddened = np.random.default_rng(3).random(image.shape[:2]) < share
    image[..., 2][reddened] = image[..., 2][reddened] + round(levels)
    return image


def test_a_picture_without_colour_is_not_gone_by_for_it_cannot_show_crop() -> None:
    found = watching().objection(frame(coloured(0)), track_of())
    assert found is not None
    assert found.fault is FaultKind.CAMERA_BLIND
    assert "0% of the picture has a colour, limit 5%" in found.said


@pytest.mark.parametrize("levels", [COLOUR_LEVELS + 1, 30])
def test_the_dullest_soil_has_colour_enough(levels: int) -> None:
    assert watching().objection(frame(coloured(levels, 2 * COLOURED_SHARE)), track_of()) is None


def test_a_picture_in_which_nothing_can_be_told_apart_is_not_gone_by() -> None:
    image = np.broadcast_to(np.array([60, 110, 80], np.uint8), (360, 640, 3)).copy()
    found = watching().objection(frame(image), track_of())
    assert found is not None
    assert found.fault is FaultKind.CAMERA_BLIND
    assert "nothing can be told apart in it, detail 0.0, limit 0.8" in found.said


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
