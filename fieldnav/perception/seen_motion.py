"""How the ground moves through a picture, against how it should by what the wheels report."""

from math import cos, sin

import cv2
import numpy as np

from fieldnav.messages import Floats, Image
from fieldnav.perception.sidestep.wheel_motion import Travelled
from fieldnav.pinhole import Pinhole

SHRINK = 4  # a plant of 3 cm is then some 6 pixels wide, and shaking by a pixel is nothing
MARGIN = 0.25  # of a patch, on each side: so far what was in its middle is looked for
SMOOTH_PX = 2.0  # standard deviation: sensor noise is gone, plants are not
LEAST_ALIKE = 0.5  # correlation of what is found again; another place has less
HALF = 0.5  # of the picture's width and height, about its middle: further out it stretches as it moves


def patch(image: Image) -> Floats:
    """The plants in the middle of a picture: excess green, small and smooth, float32.

    Shape about (height / 8, width / 8). Grey would show what does not move as well: vignetting, shadow.
    """
    height, width = image.shape[:2]
    top, left = round(height * (1 - HALF) / 2), round(width * (1 - HALF) / 2)
    middle = image[top : height - top, left : width - left]
    size = (middle.shape[1] // SHRINK, middle.shape[0] // SHRINK)
    small = cv2.resize(middle, size, interpolation=cv2.INTER_AREA)
    blue, green, red = cv2.split(small.astype(np.float32))
    return np.asarray(cv2.GaussianBlur(2 * green - blue - red, (0, 0), SMOOTH_PX))


def expected_px(camera: Pinhole, moved: Travelled) -> Floats:
    """By how much what is in the picture's middle should move, shape (2,), x and y."""
    centre = np.array([camera.centre_x_px, camera.centre_y_px])
    ahead, left = camera.to_ground(centre) - [moved.ahead_m, moved.left_m]
    c, s = cos(moved.turn_rad), sin(moved.turn_rad)
    return np.asarray(camera.to_image(np.array([c * ahead + s * left, c * left - s * ahead])) - centre)


def agreement(before: Floats, after: Floats, expected: Floats) -> float:
    """1 where two patches show the expected motion, 0 where they show none along it, -1 the opposite one.

    0 also where the one is not found again in the other.
    """
    height, width = before.shape
    top, left = round(height * MARGIN), round(width * MARGIN)
    inner = before[top : height - top, left : width - left]
    alike = cv2.matchTemplate(after, inner, cv2.TM_CCOEFF_NORMED)
    _, best, _, place = cv2.minMaxLoc(alike)
    if best < LEAST_ALIKE:
        return 0.0
    shift = SHRINK * (np.array(place) - [left, top])
    return float(shift @ expected / (expected @ expected))
