"""How the ground moves through a picture, against how it should by what the wheels report."""

from math import cos, sin

import cv2
import numpy as np

from fieldnav.messages import Floats, Image
from fieldnav.perception.sidestep.wheel_motion import Travelled
from fieldnav.pinhole import Pinhole

SHRINK = 4  # a plant of 3 cm is then some 6 pixels wide, and shaking by a pixel is nothing
HALF = 0.5  # of the picture's width and height, about its middle: further out it stretches as it moves


def patch(image: Image) -> Floats:
    """The middle of a picture, grey and small; float32, shape about (height / 8, width / 8)."""
    height, width = image.shape[:2]
    top, left = round(height * (1 - HALF) / 2), round(width * (1 - HALF) / 2)
    middle = image[top : height - top, left : width - left]
    size = (middle.shape[1] // SHRINK, middle.shape[0] // SHRINK)
    small = cv2.resize(middle, size, interpolation=cv2.INTER_AREA)
    return np.asarray(cv2.cvtColor(small, cv2.COLOR_BGR2GRAY), dtype=np.float32)


def expected_px(camera: Pinhole, moved: Travelled) -> Floats:
    """By how much what is in the picture's middle should move, shape (2,), x and y."""
    centre = np.array([camera.centre_x_px, camera.centre_y_px])
    ahead, left = camera.to_ground(centre) - [moved.ahead_m, moved.left_m]
    c, s = cos(moved.turn_rad), sin(moved.turn_rad)
    return np.asarray(camera.to_image(np.array([c * ahead + s * left, c * left - s * ahead])) - centre)


def agreement(before: Floats, after: Floats, expected: Floats) -> float:
    """1 where two patches show the expected motion, 0 where they show none along it, -1 the opposite one."""
    window = cv2.createHanningWindow((before.shape[1], before.shape[0]), cv2.CV_32F)
    shift, _ = cv2.phaseCorrelate(before, after, window)
    return float(SHRINK * np.asarray(shift) @ expected / (expected @ expected))
