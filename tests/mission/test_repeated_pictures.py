"""Pictures that were shown before are told from new ones, and from a camera that stands for a moment."""

import numpy as np
import pytest

from fieldnav.mission.repeated_pictures import MIN_REPEATED, MOVED_M, REMEMBERED_S, RepeatedPictures
from fieldnav.odometry import Pose

FRAME_S, STEP_M = 1 / 15, 0.03


def picture(number: int) -> np.ndarray:
    return np.random.default_rng(number).integers(0, 255, (20, 30, 3)).astype(np.uint8)


def ages(numbers: list[int], step_m: float = STEP_M, frame_s: float = FRAME_S) -> list[float | None]:
    """What is said of pictures by their numbers, one a frame, the robot a step further each time."""
    seen = RepeatedPictures()
    return [seen.age_s(picture(number), at * frame_s, Pose(at * step_m)) for at, number in enumerate(numbers)]


def test_new_pictures_are_passed() -> None:
    assert ages(list(range(100))) == [None] * 100


def test_a_stream_that_jumps_back_is_told_with_its_age() -> None:
    said = ages([*range(30), *range(10, 20)])
    assert said[:31] == [None] * 31
    assert said[31:] == pytest.approx([20 * FRAME_S] * 9)


def test_two_pictures_in_turn_are_told() -> None:
    said = ages([0, 1, 2, 3, 0, 1, 0, 1])
    assert all(age is not None for age in said[3 + MIN_REPEATED :])


def test_a_camera_that_gives_one_picture_again_and_again_is_frozen_and_not_this() -> None:
    assert ages([0, 1, 2, *[2] * 20, 3, 4]) == [None] * 25


def test_one_picture_that_comes_again_is_borne() -> None:
    assert ages([*range(10), 3, *range(10, 20)]) == [None] * 21


def test_while_the_robot_stands_pictures_may_come_again() -> None:
    assert ages([0, 1] * 20, step_m=MOVED_M / 100) == [None] * 40


def test_what_lies_longer_back_than_is_remembered_is_forgotten() -> None:
    frames = round(REMEMBERED_S) + 5
    assert ages([*range(frames), 0, 1, 2], frame_s=1.0)[-3:] == [None] * 3
