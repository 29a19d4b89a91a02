"""What is believed of pictures: here, of those that straight driving cannot tell apart."""

import numpy as np
import pytest

from fieldnav.estimation.picture_motion import DELAYS_S, Lie, PictureMotion
from fieldnav.messages import Floats

SPEED_MPS, FRAME_S, REACH_M2 = 0.5, 1 / 15, 0.03
JUMPS, FRAMES = 20, 30
"""Frames that follow on each jump of the pictures: two seconds."""


def places(at_s: float) -> Floats:
    """Where the view was by each delay, shape (2, delays), straight ahead at a constant speed."""
    along_m = SPEED_MPS * (at_s - DELAYS_S)
    return np.stack([along_m, np.zeros_like(along_m)])


def test_jumps_do_not_make_mirrored_pictures_likely_while_the_robot_drives_straight() -> None:
    belief, random, now_s = PictureMotion(), np.random.default_rng(1), 0.0
    for _ in range(JUMPS):
        belief.lost(0.0)
        for _ in range(FRAMES):
            before, now_s = now_s, now_s + FRAME_S
            seen_m = np.array([SPEED_MPS * FRAME_S, 0.0]) + random.normal(0, 0.003, 2)
            belief.seen(places(before), places(now_s), seen_m, FRAME_S, REACH_M2, -2.0)
        assert belief.probability(Lie.MIRRORED) < 1e-3


OBLIQUE = 4.0
"""How far pitch moves the ground of a camera that looks ahead, against one that looks down."""
PITCH_HZ, PITCH_M = 1.5, 0.08
"""A degree rms moves the ground so far, a metre and three quarters ahead."""
DRIVEN_M, FOUND_M = 20.0, 2.0


def pitching(belief: PictureMotion, metres: float, share: float = 1.0) -> float:
    """Drive straight on while the robot pitches, by pictures that show so much of it; metres until a lie is
    believed."""
    now_s = 0.0
    while SPEED_MPS * now_s < metres and belief.followed > 1e-3:
        before, now_s = now_s, now_s + FRAME_S
        moved_m = SPEED_MPS * FRAME_S
        pitch_m = 2**0.5 * PITCH_M * np.diff(np.sin(2 * np.pi * PITCH_HZ * np.array([before, now_s])))[0]
        seen_m = np.array([share * (moved_m + pitch_m), 0.0])
        belief.seen(places(before), places(now_s), seen_m, FRAME_S, OBLIQUE**2 * REACH_M2, -2.0)
    return SPEED_MPS * now_s


def test_a_view_that_pitch_moves_far_is_not_accused_of_it() -> None:
    belief = PictureMotion(OBLIQUE)

    assert pitching(belief, DRIVEN_M) == pytest.approx(DRIVEN_M, abs=0.1)
    assert belief.followed > 0.99 and belief.delay.mean_s < 0.3


def test_ground_that_stands_still_in_such_a_view_is_found_out_a_little_later() -> None:
    steep_m, oblique_m = (pitching(PictureMotion(each), DRIVEN_M, 0.0) for each in (1.0, OBLIQUE))

    assert steep_m < oblique_m < FOUND_M
