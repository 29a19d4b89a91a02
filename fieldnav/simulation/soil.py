"""Bare ground as two repeating textures of brightness: crumbs and clods, and the litter that lies on them.

Values are steps of the soil's colour ramp (see rendering/palette). The textures' periods have no common
measure on the scale of a field, so that no piece of ground looks like another.
"""

from dataclasses import dataclass
from math import cos, pi, sin

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.settings.field import Ground
from fieldnav.simulation.streams import Stream, random_stream

Texture = NDArray[np.uint8]

PIXEL_M = 0.00125  # about what a pixel of the robot's cameras sees
CRUMB_PIXELS = 2048  # period 2.56 m
LITTER_PIXELS = 1728  # period 2.16 m
SOIL_STEPS = 92  # of the colour ramp
SOIL_MEAN = 36.0  # the step that has the soil's own colour
BRIGHTEST_STEP = SOIL_STEPS - 6  # leaves room for the mottle that the renderer adds
BARE = 0  # in the litter texture: nothing lies here

CRUMBS_PER_M2 = {0.016: 60, 0.009: 500, 0.005: 3500, 0.0028: 14000}  # radius in metres: how many
COARSE_CRUMB_M = 0.007  # from this radius on, their number follows the soil's roughness
ROLLING_CELLS, ROLLING_M = 16, 0.010  # gentle waves of the surface
FINE_CELLS, FINE_M = 512, 0.0004
UNEVEN_CELLS, UNEVEN = 256, 0.35  # how far crumbs are from round
CRACK_CELLS = 32
CRACK_WIDTH = 0.035  # of the noise's standard deviation
CRACK_DEPTH = 0.35
RELIEF = 0.30  # contrast of lit against unlit crumb sides
CREVICE = 0.10  # darkness between crumbs
GRAIN = 0.05  # rms of the finest speckle

STRAW_M = (0.012, 0.15)  # length, few long ones
STRAW_WIDTH_M = (0.0012, 0.004)
STRAW_PER_M2 = 420.0  # at full cover
STRAW_STEPS = (40, BRIGHTEST_STEP)  # weathered to fresh
STONE_M = (0.004, 0.022)  # radius, few large ones
STONES_PER_M2 = 160.0  # at full cover
STONE_STEPS = (40, 66)
CAST_STEP = 14  # the dark rim on the side away from the sun
CAST_PIXELS = 1.5
SUBPIXEL = 4  # bits


@dataclass(frozen=True, slots=True)
class Soil:
    """The two textures, square; `litter` is BARE where crumbs show."""

    crumbs: Texture
    litter: Texture


def make_soil(ground: Ground, azimuth_rad: float, sunshine: float, seed: int) -> Soil:
    """Textures of a field's soil, lit from the sun's azimuth. Columns run along -y, rows along -x."""
    towards_sun = (-sin(azimuth_rad), -cos(azimuth_rad))  # of a picture whose columns are -y and rows -x
    return Soil(
        crumbs=_crumbs(ground, towards_sun, sunshine, random_stream(seed, Stream.SOIL)),
        litter=_litter(ground, towards_sun, random_stream(seed, Stream.LITTER)),
    )


def repeating_noise(random: np.random.Generator, pixels: int, cells: int) -> Floats:
    """Smooth noise of unit variance over a square that repeats seamlessly, shape (pixels, pixels)."""
    margin = 2
    grid = random.standard_normal((cells, cells)).astype(np.float32)
    grid = np.pad(grid, margin, mode="wrap")
    scale = pixels // cells
    large = cv2.resize(grid, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC)
    inner = large[margin * scale : margin * scale + pixels, margin * scale : margin * scale + pixels]
    return np.asarray(inner / inner.std())


def _crumbs(
    ground: Ground, towards_sun: tuple[float, float], sunshine: float, random: np.random.Generator
) -> Texture:
    """Clods and crumbs on a rolling surface, shaded from the sun's side, with crevices and cracks."""
    height = ROLLING_M * repeating_noise(random, CRUMB_PIXELS, ROLLING_CELLS)
    height += FINE_M * repeating_noise(random, CRUMB_PIXELS, FINE_CELLS)
    crumbs = np.zeros_like(height)
    for radius_m, per_m2 in CRUMBS_PER_M2.items():
        number = per_m2 * (2 * ground.roughness if radius_m >= COARSE_CRUMB_M else 1.0)
        crumbs = np.maximum(crumbs, _domes(random, radius_m, number))
    height += crumbs
    slope_x = np.roll(height, -1, 1) - np.roll(height, 1, 1)
    slope_y = np.roll(height, -1, 0) - np.roll(height, 1, 0)
    relief = -(slope_x * towards_sun[0] + slope_y * towards_sun[1])
    light = 1 + RELIEF * (0.4 + 0.6 * sunshine) * np.tanh(relief / relief.std())
    light += CREVICE * np.tanh((crumbs - crumbs.mean()) / crumbs.std())
    light += GRAIN * random.standard_normal(light.shape, dtype=np.float32)
    crack = np.abs(repeating_noise(random, CRUMB_PIXELS, CRACK_CELLS)) < CRACK_WIDTH
    light -= CRACK_DEPTH * (1 - ground.roughness) * crack
    return np.clip(SOIL_MEAN * light, 1, BRIGHTEST_STEP).astype(np.uint8)


def _domes(random: np.random.Generator, radius_m: float, per_m2: float) -> NDArray[np.float32]:
    """Height in metres of round crumbs strewn over the repeating square, shape (pixels, pixels)."""
    margin = round(radius_m / PIXEL_M) + 1
    free = np.ones((CRUMB_PIXELS, CRUMB_PIXELS), np.uint8)
    number = random.poisson(per_m2 * (CRUMB_PIXELS * PIXEL_M) ** 2)
    free[tuple(random.integers(0, CRUMB_PIXELS, (2, number)))] = 0
    distance = cv2.distanceTransform(np.pad(free, margin, mode="wrap"), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    inner = distance[margin:-margin, margin:-margin] * PIXEL_M
    uneven = 1 + UNEVEN * repeating_noise(random, CRUMB_PIXELS, UNEVEN_CELLS)
    return np.asarray(np.sqrt(np.maximum(radius_m**2 - (inner * uneven) ** 2, 0)), dtype=np.float32)


def _litter(ground: Ground, towards_sun: tuple[float, float], random: np.random.Generator) -> Texture:
    """Stones and straw, each with a dark rim on the side away from the sun."""
    texture: Texture = np.full((LITTER_PIXELS, LITTER_PIXELS), BARE, np.uint8)
    area_m2 = (LITTER_PIXELS * PIXEL_M) ** 2
    rim = -np.array(towards_sun) * CAST_PIXELS
    for _ in range(random.poisson(STONES_PER_M2 * ground.stones * area_m2)):
        outline = _stone(random)
        step = int(random.integers(*STONE_STEPS))
        _lay(texture, outline + rim, CAST_STEP)
        _lay(texture, outline, step)
        _lay(
            texture, (outline - outline.mean(axis=0)) * 0.6 + outline.mean(axis=0) - rim / 2, step + CAST_STEP
        )
    for _ in range(random.poisson(STRAW_PER_M2 * ground.residue * area_m2)):
        outline = _straw(random)
        _lay(texture, outline + rim, CAST_STEP)
        _lay(texture, outline, int(random.integers(*STRAW_STEPS)))
    return texture


def _stone(random: np.random.Generator) -> Floats:
    """An uneven oval, in pixels, shape (9, 2)."""
    smallest, largest = STONE_M
    radius = smallest * (largest / smallest) ** (random.random() ** 2) / PIXEL_M
    angles = np.linspace(0, 2 * pi, 9, endpoint=False)
    radii = radius * random.uniform(0.8, 1.1, angles.size)
    oval = np.stack([radii * np.cos(angles), radii * np.sin(angles) * random.uniform(0.55, 1)], axis=-1)
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
