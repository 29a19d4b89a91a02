"""Bare ground as two repeating textures of brightness: crumbs and clods, and the litter that lies on them.

Values are steps of the soil's colour ramp (see rendering/palette). The textures' periods of 1.92 m
and 2.16 m meet only every 17 m, and moisture has another, so that the repetition is not seen.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import cos, sin

import cv2
import numpy as np

from fieldnav.settings.field import Ground
from fieldnav.simulation.litter import strew_litter
from fieldnav.simulation.streams import Stream, random_stream
from fieldnav.simulation.texture import BRIGHTEST_STEP, PIXEL_M, SOIL_MEAN, Reals, Texture, repeating_noise

CRUMB_PIXELS = 1536  # period 1.92 m

CRUMBS_PER_M2 = {0.016: 60, 0.009: 500, 0.005: 3500, 0.0028: 14000}  # radius in metres: how many
COARSE_CRUMB_M = 0.007  # from this radius on, their number follows the soil's roughness
ROLLING_CELLS, ROLLING_M = 12, 0.010  # gentle waves of the surface
FINE_CELLS, FINE_M = 512, 0.0002
UNEVEN_CELLS, UNEVEN = 128, 0.22  # how far crumbs are from round
CRACK_CELLS = 24
CRACK_WIDTH = 0.035  # of the noise's standard deviation
CRACK_DEPTH = 0.35
RELIEF = 0.30  # contrast of lit against unlit crumb sides
SKY_RELIEF = 0.4  # share of the contrast that is left under an overcast sky
CREVICE = 0.10  # darkness between crumbs
GRAIN = 0.05  # rms of the finest speckle


@dataclass(frozen=True, slots=True)
class Soil:
    """The two textures, square; `litter` is BARE where crumbs show."""

    crumbs: Texture
    litter: Texture


@lru_cache(maxsize=2)  # a second run of the same field, or its mirrored twin, has the same soil
def make_soil(ground: Ground, azimuth_rad: float, sunshine: float, seed: int) -> Soil:
    """Textures of a field's soil, lit from the sun's azimuth. Columns run along -y, rows along -x."""
    towards_sun = (-sin(azimuth_rad), -cos(azimuth_rad))  # of a picture whose columns are -y and rows -x
    return Soil(
        crumbs=_crumbs(ground, towards_sun, sunshine, random_stream(seed, Stream.SOIL)),
        litter=strew_litter(ground, towards_sun, random_stream(seed, Stream.LITTER)),
    )


def _crumbs(
    ground: Ground, towards_sun: tuple[float, float], sunshine: float, random: np.random.Generator
) -> Texture:
    """Clods and crumbs on a rolling surface, shaded from the sun's side, with crevices and cracks."""
    height = ROLLING_M * repeating_noise(random, CRUMB_PIXELS, ROLLING_CELLS)
    height += FINE_M * repeating_noise(random, CRUMB_PIXELS, FINE_CELLS)
    crumbs = np.zeros_like(height)
    uneven = 1 + UNEVEN * repeating_noise(random, CRUMB_PIXELS, UNEVEN_CELLS)
    for radius_m, per_m2 in CRUMBS_PER_M2.items():
        number = per_m2 * (2 * ground.roughness if radius_m >= COARSE_CRUMB_M else 1.0)
        crumbs = np.maximum(crumbs, _domes(random, radius_m, number, uneven))
    height += crumbs
    slope_x = np.roll(height, -1, 1) - np.roll(height, 1, 1)
    slope_y = np.roll(height, -1, 0) - np.roll(height, 1, 0)
    relief = -(slope_x * towards_sun[0] + slope_y * towards_sun[1])
    light = 1 + RELIEF * (SKY_RELIEF + (1 - SKY_RELIEF) * sunshine) * np.tanh(relief / relief.std())
    light += CREVICE * np.tanh((crumbs - crumbs.mean()) / crumbs.std())
    light += GRAIN * random.standard_normal(light.shape, dtype=np.float32)
    crack = np.abs(repeating_noise(random, CRUMB_PIXELS, CRACK_CELLS)) < CRACK_WIDTH
    light -= CRACK_DEPTH * (1 - ground.roughness) * crack
    return np.asarray(np.clip(SOIL_MEAN * light, 1, BRIGHTEST_STEP), dtype=np.uint8)


def _domes(random: np.random.Generator, radius_m: float, per_m2: float, uneven: Reals) -> Reals:
    """Height in metres of crumbs strewn over the repeating square, out of round by `uneven`, about 1."""
    margin = round(radius_m / PIXEL_M) + 1
    free = np.ones((CRUMB_PIXELS, CRUMB_PIXELS), np.uint8)
    number = random.poisson(per_m2 * (CRUMB_PIXELS * PIXEL_M) ** 2)
    free[tuple(random.integers(0, CRUMB_PIXELS, (2, number)))] = 0
    distance = cv2.distanceTransform(np.pad(free, margin, mode="wrap"), cv2.DIST_L2, cv2.DIST_MASK_5)
    inner = distance[margin:-margin, margin:-margin]
    rise = np.float32(radius_m**2) - np.square(inner * np.float32(PIXEL_M) * uneven)
    return np.asarray(np.sqrt(np.maximum(rise, 0)))
