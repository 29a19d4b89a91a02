"""Shapes of all sizes that cover one another: images with the statistics of natural ones, but without rows.

Lee, Mumford, Huang, "Occlusion Models for Natural Images", 2001.
"""

from dataclasses import dataclass

import numpy as np

from fieldnav.training.canvas import (
    HEIGHT_PX,
    WIDTH_PX,
    Canvas,
    Colour,
    Range,
    chance,
    draw_line,
    fill_ellipse,
    fill_polygon,
    log_uniform,
    shaded,
    smooth_noise,
)
from fieldnav.training.colours import any_colour, foliage_colour, soil_colour
from fieldnav.training.surfaces import FINE_OCTAVES, plain_surface

COLOURS = (1, 6)  # from, and below
LEAVES: Range = (30, 700)
SMALLEST_PX: Range = (0.8, 4)
LARGEST_PX: Range = (15, 70)
EXPONENT: Range = (1.2, 2.8)  # of the sizes' power law
FOLIAGE_SHARE, SOIL_SHARE = 0.4, 0.4  # of the colours; the latter of those that are not foliage
OTHER_SATURATION, OTHER_VALUE = (0.0, 220.0), (20.0, 240.0)

ALIGNED_SHARE = 0.5  # all leaves lie about one way
ANY_WAY_SHARE, UPRIGHT_DEG = (
    0.6,
    12.0,
)  # of these: lie any way; the others stand up within a deviation of so much
SPREAD_DEG: Range = (3, 40)
SLENDER: Range = (0.08, 1)  # breadth over length
COLOUR_SPREAD: Range = (0.03, 0.3)
SHADOW_SHARE, SHADOW, SHADOW_OFFSET, MIN_SHADOW_PX = 0.4, 0.35, (0.2, 0.25), 2.0
PERSPECTIVE_SHARE, FAR_SIZE, NEAR_SIZE = 0.4, 0.25, 1.1  # smaller towards the top
MARGIN_PX = 10
ELLIPSES_UP_TO, POLYGONS_UP_TO = 0.7, 0.85  # shares of the shapes
BREADTH: Range = (0.6, 1.4)
CORNERS = (3, 6)
STALK_LENGTH, STALK_THICKNESS = 2.0, 0.25  # in radii
VEIL_SHARE, VEIL = 0.6, (0.03, 0.2)  # smooth differences of brightness over everything
SURFACE_SHARE = 0.35  # of any surface


@dataclass(frozen=True, slots=True)
class Litter:
    """What the shapes of one image have in common; `angle_deg` None when they lie any way."""

    palette: list[Colour]
    radii_px: list[float]
    angle_deg: float | None
    spread_deg: float
    slender: float
    colour_spread: float
    shadows: bool
    perspective: bool


def draw_dead_leaves(random: np.random.Generator) -> Canvas:
    """An image of shapes from large to small."""
    litter = _draw_litter(random)
    canvas = np.empty((HEIGHT_PX, WIDTH_PX, 3), np.float32)
    canvas[:] = litter.palette[0]
    for radius_px in litter.radii_px:
        _draw_leaf(random, canvas, litter, radius_px)
    if chance(random, VEIL_SHARE):
        canvas *= (1 + smooth_noise(random, FINE_OCTAVES) * random.uniform(*VEIL))[..., None]
    return canvas


def any_surface(random: np.random.Generator) -> Canvas:
    """Dead leaves, or a surface without single things."""
    return draw_dead_leaves(random) if chance(random, SURFACE_SHARE) else plain_surface(random)


def _draw_litter(random: np.random.Generator) -> Litter:
    palette = [_leaf_colour(random) for _ in range(random.integers(*COLOURS))]
    radii_px = _draw_radii(random, int(log_uniform(random, LEAVES)))
    aligned = chance(random, ALIGNED_SHARE)
    any_way = chance(random, ANY_WAY_SHARE)
    angle_deg = random.uniform(0, 180) if any_way else 90 + random.normal(0, UPRIGHT_DEG)
    return Litter(
        palette=palette,
        radii_px=radii_px,
        angle_deg=angle_deg if aligned else None,
        spread_deg=random.uniform(*SPREAD_DEG),
        slender=log_uniform(random, SLENDER),
        colour_spread=random.uniform(*COLOUR_SPREAD),
        shadows=chance(random, SHADOW_SHARE),
        perspective=chance(random, PERSPECTIVE_SHARE),
    )


def _leaf_colour(random: np.random.Generator) -> Colour:
    if chance(random, FOLIAGE_SHARE):
        return foliage_colour(random)
    if chance(random, SOIL_SHARE):
        return soil_colour(random)
    return any_colour(random, OTHER_SATURATION, OTHER_VALUE)


def _draw_radii(random: np.random.Generator, count: int) -> list[float]:
    """Radii of a power law, from large to small."""
    smallest_px, largest_px = random.uniform(*SMALLEST_PX), random.uniform(*LARGEST_PX)
    power = 1 - random.uniform(*EXPONENT)
    low, high = smallest_px**power, largest_px**power
    radii = (low + random.random(count) * (high - low)) ** (1 / power)
    return [float(radius) for radius in np.sort(radii)[::-1]]


def _draw_leaf(random: np.random.Generator, canvas: Canvas, litter: Litter, radius_px: float) -> None:
    x = random.uniform(-MARGIN_PX, WIDTH_PX + MARGIN_PX)
    y = random.uniform(-MARGIN_PX, HEIGHT_PX + MARGIN_PX)
    if litter.perspective:
        radius_px *= FAR_SIZE + NEAR_SIZE * max(y, 0) / HEIGHT_PX
    colour = litter.palette[random.integers(len(litter.palette))]
    colour = shaded(colour, 1 + random.normal(0, litter.colour_spread))
    angle_deg = _draw_angle(random, litter)
    kind = random.random()
    if litter.shadows and radius_px > MIN_SHADOW_PX:
        fallen = x + radius_px * SHADOW_OFFSET[0], y + radius_px * SHADOW_OFFSET[1]
        radii = radius_px, radius_px * litter.slender
        fill_ellipse(canvas, fallen, radii, angle_deg, colour * SHADOW)
    if kind < ELLIPSES_UP_TO:
        radii = radius_px, radius_px * litter.slender * random.uniform(*BREADTH)
        fill_ellipse(canvas, (x, y), radii, angle_deg, colour)
    elif kind < POLYGONS_UP_TO:
        corners = np.array([x, y]) + random.normal(0, radius_px, (random.integers(*CORNERS), 2))
        fill_polygon(canvas, corners, colour.tolist())
    else:
        angle_rad, reach_px = np.radians(angle_deg), radius_px * STALK_LENGTH
        right, down = np.cos(angle_rad) * reach_px, np.sin(angle_rad) * reach_px
        start, end = (x - right, y - down), (x + right, y + down)
        draw_line(canvas, start, end, colour, radius_px * STALK_THICKNESS)


def _draw_angle(random: np.random.Generator, litter: Litter) -> float:
    if litter.angle_deg is None:
        return random.uniform(0, 180)
    return litter.angle_deg + random.normal(0, litter.spread_deg)
