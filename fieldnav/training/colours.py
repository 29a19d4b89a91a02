"""Colours of soil, of foliage and of anything, drawn at random; wider than any camera shows them."""

import cv2
import numpy as np

from fieldnav.training.canvas import Colour, Range, chance

HALF_TURN = 180  # OpenCV's hues are half degrees
BYTE = 255
ANY_HUE: Range = (0, HALF_TURN)
FULL: Range = (0, BYTE)

HsvRanges = tuple[Range, Range, Range]
"""Limits of hue in half degrees, of saturation and of value, the latter two from 0 to 255."""

BROWN: HsvRanges = ((6, 22), (25, 130), (50, 215))
GREY: HsvRanges = ((0, 30), (5, 50), (60, 220))
PINKISH: HsvRanges = ((165, 190), (20, 110), (80, 200))
STRAW: HsvRanges = ((12, 28), (60, 150), (140, 230))
SOILS = ((0.55, BROWN), (0.20, GREY), (0.13, PINKISH), (0.12, STRAW))  # with their shares

LEAF_GREEN: HsvRanges = ((34, 62), (60, 190), (60, 200))
YELLOWISH: HsvRanges = ((26, 38), (50, 150), (110, 220))
BLUISH: HsvRanges = ((50, 85), (25, 110), (70, 190))
BACKLIT: HsvRanges = ((22, 34), (110, 220), (150, 255))
FOLIAGE = ((0.62, LEAF_GREEN), (0.14, YELLOWISH), (0.10, BACKLIT), (0.14, BLUISH))


def any_colour(random: np.random.Generator, saturation: Range = FULL, value: Range = (10, BYTE)) -> Colour:
    """A colour of any hue."""
    return draw_colour(random, (ANY_HUE, saturation, value))


def soil_colour(random: np.random.Generator) -> Colour:
    """The colour of bare ground: brown, grey, reddish or that of straw."""
    return _of_kinds(random, SOILS)


def foliage_colour(random: np.random.Generator) -> Colour:
    """The colour of leaves: green, yellowish, with the sun behind them, or bluish grey."""
    return _of_kinds(random, FOLIAGE)


def foliage_or_any(random: np.random.Generator, foliage_share: float) -> Colour:
    """The colour of leaves in a share of the calls, otherwise any."""
    return foliage_colour(random) if chance(random, foliage_share) else any_colour(random)


def draw_colour(random: np.random.Generator, ranges: HsvRanges) -> Colour:
    """A colour between the limits."""
    hue, saturation, value = (random.uniform(*limits) for limits in ranges)
    pixel = np.array([[[hue % HALF_TURN, saturation, value]]]).astype(np.uint8)
    return np.asarray(cv2.cvtColor(pixel, cv2.COLOR_HSV2BGR)[0, 0], np.float32)


def _of_kinds(random: np.random.Generator, kinds: tuple[tuple[float, HsvRanges], ...]) -> Colour:
    kind = random.random()
    for share, ranges in kinds[:-1]:
        if kind < share:
            return draw_colour(random, ranges)
        kind -= share
    return draw_colour(random, kinds[-1][1])
