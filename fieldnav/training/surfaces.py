"""Surfaces without single things on them: ground, foliage, sky, and the regions of an image they fill."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from fieldnav.training.canvas import (
    HEIGHT_PX,
    WIDTH_PX,
    X_PX,
    Y_PX,
    Canvas,
    Colour,
    Coverage,
    Range,
    blend,
    chance,
    smooth_noise,
    soften,
)
from fieldnav.training.colours import HsvRanges, any_colour, draw_colour, foliage_colour, soil_colour

FINE_OCTAVES, MIDDLE_OCTAVES, COARSE_OCTAVES = 8, 4, 3
COVER_OCTAVES, CLOUD_OCTAVES = 7, 5
CONTRAST = 0.5  # of a surface, at a strength of 1
GRAIN: Range = (0.2, 1.0)  # strength of the pixels' own noise, in that of the surface
GRAIN_SIZE_PX: Range = (0.3, 1.6)
GRAIN_GAIN = 1.5  # what a blur of one pixel takes away, about
TINT: Range = (0, 8)  # grey levels by which blue and red part in places

FOLIAGE_STRENGTH: Range = (0.15, 0.7)
GAPS_SHARE = 0.5  # of the foliage through which the soil shows
GAP_LEVEL: Range = (-1.5, 1.0)  # deviations of the noise
GAP_SHARPNESS: Range = (2, 8)
GAP_SOIL_CONTRAST = 0.2
FOLIAGE_UP_TO, SOIL_UP_TO = 0.35, 0.6  # shares of the plain surfaces
SOIL_STRENGTH: Range = (0.05, 0.6)
PLAIN_VALUE, PLAIN_STRENGTH = (20.0, 255.0), (0.0, 0.4)

REGION_EDGE_PX: Range = (0.5, 6)  # deviation of a region's edge from a smooth line
REGION_BLUR_PX: Range = (0.4, 2)
HALF_FROM: Range = (0.15, 0.48)  # of the image's extent in the region's direction
CORNER_WIDTHS, CORNER_HEIGHTS, CORNER_BELOW_SHARE = (0.1, 0.5), (0.3, 1.4), 0.3
BAND_TOP_HEIGHTS, BAND_HEIGHTS, BAND_SLOPE, BAND_EDGE = (0.0, 0.5), (0.05, 0.3), 0.15, 0.5
SPOT_LEVEL: Range = (0.6, 1.6)  # deviations of the noise

SKY: HsvRanges = ((90, 120), (0, 150), (120, 255))
SKY_EDGE_PX: Range = (0, 6)
SKY_SHARPNESS: Range = (0.5, 2)  # per pixel
MAX_EXPONENT = 30
CLOUDS, SKY_FALL = (0.0, 25.0), (0.0, 60.0)  # grey levels, the latter from the top to the bottom
HEDGE_SHARE = 0.6
HEDGE_PX: Range = (1, 22)
HEDGE_SHADE, HEDGE_STRENGTH = (0.3, 1.0), 0.4
HEDGE_ABOVE, HEDGE_BELOW, HEDGE_ROUGH = 0.7, 0.3, 0.4  # of its height
HEDGE_BLUR_PX = 1.2


def textured(random: np.random.Generator, colour: Colour, strength: float) -> Canvas:
    """A surface of one colour with smooth and fine differences of brightness."""
    smooth = smooth_noise(random, FINE_OCTAVES) * strength
    grain = (
        random.standard_normal((HEIGHT_PX, WIDTH_PX)).astype(np.float32) * strength * random.uniform(*GRAIN)
    )
    size_px = random.uniform(*GRAIN_SIZE_PX)
    grain = soften(grain, size_px) * size_px * GRAIN_GAIN
    tint = smooth_noise(random, MIDDLE_OCTAVES) * random.uniform(*TINT)
    brightness = 1 + (smooth + grain) * CONTRAST
    channels = [colour[channel] * brightness + tint * (channel - 1) for channel in range(len(colour))]
    return np.stack(channels, axis=-1)


def bare_ground(random: np.random.Generator, strength: Range) -> Canvas:
    """Soil of any colour."""
    return textured(random, soil_colour(random), random.uniform(*strength))


def foliage(random: np.random.Generator) -> Canvas:
    """Leaves without order, through which soil may show."""
    canvas = textured(random, foliage_colour(random), random.uniform(*FOLIAGE_STRENGTH))
    if not chance(random, GAPS_SHARE):
        return canvas
    soil = soil_colour(random)
    height = smooth_noise(random, FINE_OCTAVES) - random.uniform(*GAP_LEVEL)
    leaves = (1 / (1 + np.exp(-height * random.uniform(*GAP_SHARPNESS))))[..., None]
    ground = soil * (1 + GAP_SOIL_CONTRAST * smooth_noise(random, COVER_OCTAVES))[..., None]
    return np.asarray(canvas * leaves + ground * (1 - leaves), np.float32)


def plain_surface(random: np.random.Generator) -> Canvas:
    """Foliage, soil, or a surface of any colour."""
    kind = random.random()
    if kind < FOLIAGE_UP_TO:
        return foliage(random)
    if kind < SOIL_UP_TO:
        return bare_ground(random, SOIL_STRENGTH)
    return textured(random, any_colour(random, value=PLAIN_VALUE), random.uniform(*PLAIN_STRENGTH))


def draw_sky(random: np.random.Generator, canvas: Canvas, horizon_px: float) -> None:
    """Draw the sky above an image row, often with a hedge or wood before it; changes `canvas`."""
    edge = smooth_noise(random, COARSE_OCTAVES) * random.uniform(*SKY_EDGE_PX)
    below = (Y_PX - horizon_px + edge) * random.uniform(*SKY_SHARPNESS)
    above = 1 / (1 + np.exp(np.clip(below, -MAX_EXPONENT, MAX_EXPONENT)))
    colour = draw_colour(random, SKY)
    light = smooth_noise(random, CLOUD_OCTAVES) * random.uniform(*CLOUDS)
    light = light + Y_PX / HEIGHT_PX * random.uniform(*SKY_FALL)
    blend(canvas, np.asarray(colour + light[..., None], np.float32), np.asarray(above, np.float32))
    if chance(random, HEDGE_SHARE):
        _draw_hedge(random, canvas, horizon_px)


def _draw_hedge(random: np.random.Generator, canvas: Canvas, horizon_px: float) -> None:
    height_px = random.uniform(*HEDGE_PX)
    rough = np.abs(smooth_noise(random, COARSE_OCTAVES)) * height_px * HEDGE_ROUGH
    below_px = Y_PX - horizon_px
    hedge = (below_px > -height_px * HEDGE_ABOVE - rough) & (below_px < height_px * HEDGE_BELOW)
    colour = foliage_colour(random) * random.uniform(*HEDGE_SHADE)
    blend(canvas, textured(random, colour, HEDGE_STRENGTH), soften(hedge, HEDGE_BLUR_PX))


Region = Callable[[np.random.Generator, Coverage], NDArray[np.bool_]]
"""Draws which pixels a region takes, given how far its edge lies from a smooth line, in pixels."""


def half(random: np.random.Generator, edge_px: Coverage) -> NDArray[np.bool_]:
    """What lies on one side of a line of any direction."""
    angle = random.uniform(0, 2 * np.pi)
    distance = (X_PX - WIDTH_PX / 2) * np.cos(angle) + (Y_PX - HEIGHT_PX / 2) * np.sin(angle) + edge_px
    extent = WIDTH_PX * abs(np.cos(angle)) + HEIGHT_PX * abs(np.sin(angle))
    return np.asarray(distance > random.uniform(*HALF_FROM) * extent)


def corner(random: np.random.Generator, edge_px: Coverage) -> NDArray[np.bool_]:
    """One corner of the image, mostly an upper one."""
    from_side = X_PX if chance(random, 0.5) else WIDTH_PX - X_PX
    width_px = random.uniform(*CORNER_WIDTHS) * WIDTH_PX
    height_px = random.uniform(*CORNER_HEIGHTS) * HEIGHT_PX
    region = from_side / width_px + (Y_PX + edge_px) / height_px < 1
    return region[::-1] if chance(random, CORNER_BELOW_SHARE) else region


def band(random: np.random.Generator, edge_px: Coverage) -> NDArray[np.bool_]:
    """A strip across the upper part of the image."""
    top_px = random.uniform(*BAND_TOP_HEIGHTS) * HEIGHT_PX
    height_px = random.uniform(*BAND_HEIGHTS) * HEIGHT_PX
    slope = random.normal(0, BAND_SLOPE)
    depth = Y_PX - top_px - (X_PX - WIDTH_PX / 2) * slope + edge_px * BAND_EDGE
    return np.asarray((depth > 0) & (depth < height_px))


def spots(random: np.random.Generator, edge_px: Coverage) -> NDArray[np.bool_]:
    """Rounded spots anywhere; their edge is uneven by itself."""
    return np.asarray(smooth_noise(random, MIDDLE_OCTAVES) > random.uniform(*SPOT_LEVEL))


ANY_REGION: tuple[Region, ...] = (half, corner, spots, band)


def draw_region(random: np.random.Generator, kinds: tuple[Region, ...] = ANY_REGION) -> Coverage:
    """A part of the image with smooth edges, of one of these kinds."""
    kind = kinds[random.integers(len(kinds))]
    edge = smooth_noise(random, COARSE_OCTAVES) * random.uniform(*REGION_EDGE_PX)
    return soften(kind(random, edge), random.uniform(*REGION_BLUR_PX))
