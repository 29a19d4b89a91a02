"""Stones and straw on the ground, as a repeating texture."""

from math import cos, pi, sin

import cv2
import numpy as np

from fieldnav.messages import Floats
from fieldnav.settings.field import Ground
from fieldnav.simulation.texture import BARE, BRIGHTEST_STEP, PIXEL_M, Texture

LITTER_PIXELS = 1728  # period 2.16 m
STRAW_M = (0.012, 0.15)  # length, few long ones
STRAW_WIDTH_M = (0.0012, 0.004)
STRAW_PER_M2 = 420.0  # at full cover
STRAW_STEPS = (40, BRIGHTEST_STEP)  # weathered to fresh
STONE_M = (0.004, 0.022)  # radius, few large ones
STONES_PER_M2 = 160.0  # at full cover
STONE_STEPS = (40, 66)
STONE_CORNERS = 9
STONE_UNEVEN = (0.8, 1.1)  # of the radius, from corner to corner
STONE_NARROW = (0.55, 1.0)  # width over length
STONE_LIT = 0.6  # size of a stone's sunlit cap over the stone's
CAST_STEP = 14  # the dark rim on the side away from the sun
CAST_PIXELS = 1.5
SUBPIXEL = 4  # bits


def strew_litter(ground: Ground, towards_sun: tuple[float, float], random: np.random.Generator) -> Texture:
    """Stones and straw, each with a dark rim on the side away from the sun."""
    texture: Texture = np.full((LITTER_PIXELS, LITTER_PIXELS), BARE, np.uint8)
    area_m2 = (LITTER_PIXELS * PIXEL_M) ** 2
    rim = -np.array(towards_sun) * CAST_PIXELS
    for _ in range(random.poisson(STONES_PER_M2 * ground.stones * area_m2)):
        outline = _stone(random)
        step = int(random.integers(*STONE_STEPS))
        _lay(texture, outline + rim, CAST_STEP)
        _lay(texture, outline, step)
        middle = outline.mean(axis=0)
        _lay(texture, (outline - middle) * STONE_LIT + middle - rim / 2, step + CAST_STEP)
    for _ in range(random.poisson(STRAW_PER_M2 * ground.residue * area_m2)):
        outline = _straw(random)
        _lay(texture, outline + rim, CAST_STEP)
        _lay(texture, outline, int(random.integers(*STRAW_STEPS)))
    return texture


def _stone(random: np.random.Generator) -> Floats:
    """An uneven oval, in pixels, shape (STONE_CORNERS, 2)."""
    smallest, largest = STONE_M
    radius = smallest * (largest / smallest) ** (random.random() ** 2) / PIXEL_M
    angles = np.linspace(0, 2 * pi, STONE_CORNERS, endpoint=False)
    radii = radius * random.uniform(*STONE_UNEVEN, angles.size)
    oval = np.stack([radii * np.cos(angles), radii * np.sin(angles) * random.uniform(*STONE_NARROW)], axis=-1)
    return np.asarray(_turned(oval, random) + random.uniform(0, LITTER_PIXELS, 2))


def _straw(random: np.random.Generator) -> Floats:
    """A narrow quadrilateral, in pixels, shape (4, 2)."""
    shortest, longest = STRAW_M
    length = shortest * (longest / shortest) ** random.random() / PIXEL_M / 2
    width = random.uniform(*STRAW_WIDTH_M) / PIXEL_M / 2
    corners = np.array([[-length, -width], [length, -width / 2], [length, width / 2], [-length, width]])
    return np.asarray(_turned(corners, random) + random.uniform(0, LITTER_PIXELS, 2))


def _turned(outline: Floats, random: np.random.Generator) -> Floats:
    angle = random.uniform(0, 2 * pi)
    turn = np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])
    return np.asarray(outline @ turn.T)


def _lay(texture: Texture, outline: Floats, step: int) -> None:
    """Paint an outline, and its continuations on the other sides of the repeating square."""
    lower, upper = outline.min(axis=0), outline.max(axis=0)
    for shift_x in (-LITTER_PIXELS, 0, LITTER_PIXELS):
        for shift_y in (-LITTER_PIXELS, 0, LITTER_PIXELS):
            shift = np.array([shift_x, shift_y])
            if (upper + shift < 0).any() or (lower + shift > LITTER_PIXELS).any():
                continue
            corners = np.round((outline + shift) * (1 << SUBPIXEL)).astype(np.int32)
            cv2.fillConvexPoly(texture, corners, min(step, BRIGHTEST_STEP), cv2.LINE_8, SUBPIXEL)
