"""What is believed of pictures: here, of those that straight driving cannot tell apart."""

import numpy as np

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
