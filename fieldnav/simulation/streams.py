"""Random numbers of a field: one independent stream for each thing that is drawn.

Because every stream starts afresh from the field's seed, changing one thing (more weeds, another lane) moves
nothing else.
"""

from enum import IntEnum

import numpy as np


class Stream(IntEnum):
    """What is drawn; the numbers are part of the field's seed and must not change."""

    WANDER = 1
    ROW_SPACING = 2
    ROW_ENDS = 3
    LANE_GAPS = 4
    ROW_GAPS = 5
    GERMINATION = 6
    CROP_PLACE = 7
    CROP_LOOK = 8
    WEED_PLACE = 9
    WEED_LOOK = 10
    GROWTH = 11
    SOIL = 12
    LITTER = 13
    MOISTURE = 14
    NOISE = 15
    EXPOSURE = 16
    WIND = 17
    MOTTLE = 18
    WEED_LINES = 19
    WEED_LARGE = 20
    GRASS = 21
    PASS = 22
    SHAKING = 101
    START = 102
    WHEEL_ERRORS = 103
    CALIBRATION = 104
    LOST_FRAMES = 105
    CAMERA_YAW = 106


def random_stream(seed: int, stream: Stream, *place: int) -> np.random.Generator:
    """The generator for one thing at one place, such as a lane and a row."""
    return np.random.default_rng((seed, stream, *place))
