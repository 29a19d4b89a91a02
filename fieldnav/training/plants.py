"""Plants, of the crop or weeds, as simple shapes: round ones, stars, tufts of grass, and rosettes."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from fieldnav.training.canvas import (
    HEIGHT_PX,
    WHITE,
    Canvas,
    Colour,
    Range,
    chance,
    draw_line,
    fill_ellipse,
    shaded,
)
from fieldnav.training.ground_camera import Floats, Projected
from fieldnav.training.rosettes import draw_rosettes

MAX_RADIUS_HEIGHTS = 0.33  # of the image; a plant larger than that would hide the rows
MIN_SCALE_PX = 1e-3
HUE_SPREAD = 40.0  # grey levels, for a spread of the brightness of 1
MIN_RADIUS_PX = 0.3  # what is smaller does not show
MIN_STAR_PX, MIN_TUFT_PX, MIN_HIGHLIGHT_PX = 2.5, 1.5, 2.0  # what is smaller is a plain ellipse
ROSETTE_SHARE = 0.45  # of the plantings that are not grass
SHADE: Range = (0.75, 1.2)  # of single leaves

STAR_LEAVES = (4, 9)  # from, and below
LEAF_TURN_DEG = 15.0  # standard deviation
LEAF_LENGTH, LEAF_BREADTH = (0.6, 1.1), (0.14, 0.3)
LEAF_MIDDLE, LEAF_RADIUS = 0.5, 0.55  # of its length
MIN_STAR_SQUASH = 0.35  # leaves stand up a little: they are seen even at a glancing angle

BLADES_PER_PX, MIN_BLADES, MAX_BLADES = 1.2, 3, 10
BLADE_FOOT, BLADE_LENGTH, BLADE_LEAN, BLADE_UNEVEN, BLADE_THICKNESS = 0.5, (0.6, 1.6), 0.5, 0.3, 0.18
MIN_BLADE_RISE = 0.4

ROUND_ASPECT, ROUND_TURN_DEG = (0.8, 1.25), (-20.0, 20.0)
MIN_ROUND_SQUASH, MIN_HIGHLIGHT_SQUASH = 0.3, 0.4
HIGHLIGHT_ASIDE, HIGHLIGHT_RISE, HIGHLIGHT_RADII, HIGHLIGHT_SHADE = 0.3, 0.2, (0.5, 0.4), (0.8, 1.35)


class PlantShape(Enum):
    """What a plant is drawn as."""

    ROUND = "round"
    STAR = "star"
    GRASS = "grass"


SHAPES = tuple(PlantShape)


@dataclass(frozen=True, slots=True)
class PlantLook:
    """How plants look; `height` is that of the plant in its radii."""

    shape: PlantShape
    colour: Colour
    colour_spread: float
    height: float


@dataclass(frozen=True, slots=True)
class _Plant:
    """One plant on the canvas; `lift_px`: how far its height raises it in the image."""

    x_px: float
    y_px: float
    radius_px: float
    lift_px: float
    squash: float
    colour: Colour


def any_shape(random: np.random.Generator) -> PlantShape:
    """One of the shapes."""
    return SHAPES[random.integers(len(SHAPES))]


def draw_plants(
    random: np.random.Generator, canvas: Canvas, places: Projected, radii: Floats, look: PlantLook
) -> None:
    """Draw plants of these radii, shape (n,), in row spacings, the far ones first; changes `canvas`."""
    if len(places) == 0:
        return
    if look.shape is not PlantShape.GRASS and chance(random, ROSETTE_SHARE):
        draw_rosettes(random, canvas, places, radii, look.colour, look.colour_spread)
        return
    radii = np.minimum(radii, MAX_RADIUS_HEIGHTS * HEIGHT_PX / np.maximum(places.scale_px, MIN_SCALE_PX))
    count, spread = len(places), look.colour_spread
    colours = look.colour * (1 + random.normal(0, spread, (count, 1)))
    colours = (colours + random.normal(0, spread * HUE_SPREAD, (count, 3))).clip(0, WHITE)
    radii_px = radii * places.scale_px
    lifts_px = look.height * radii_px * (1 - places.squash)
    columns = places.x_px, places.y_px, radii_px, lifts_px, places.squash, colours
    for number in np.flatnonzero(radii_px >= MIN_RADIUS_PX):
        _draw_plant(random, canvas, _Plant(*(column[number] for column in columns)), look.shape)


def _draw_plant(random: np.random.Generator, canvas: Canvas, plant: _Plant, shape: PlantShape) -> None:
    if shape is PlantShape.STAR and plant.radius_px > MIN_STAR_PX:
        _draw_star(random, canvas, plant)
    elif shape is PlantShape.GRASS and plant.radius_px > MIN_TUFT_PX:
        _draw_tuft(random, canvas, plant)
    else:
        _draw_round(random, canvas, plant)


def _draw_star(random: np.random.Generator, canvas: Canvas, plant: _Plant) -> None:
    """Narrow leaves that lie flat around the middle, as of a seedling."""
    leaves, first_deg = random.integers(*STAR_LEAVES), random.uniform(0, 360)
    for leaf in range(leaves):
        angle = np.radians(first_deg + 360 * leaf / leaves + random.normal(0, LEAF_TURN_DEG))
        length_px = plant.radius_px * random.uniform(*LEAF_LENGTH)
        right = np.cos(angle) * length_px * LEAF_MIDDLE
        down = np.sin(angle) * length_px * LEAF_MIDDLE * max(plant.squash, MIN_STAR_SQUASH)
        colour = shaded(plant.colour, random.uniform(*SHADE))
        middle = plant.x_px + right, plant.y_px + down - plant.lift_px
        radii = length_px * LEAF_RADIUS, length_px * random.uniform(*LEAF_BREADTH)
        fill_ellipse(canvas, middle, radii, float(np.degrees(np.arctan2(down, right))), colour)


def _draw_tuft(random: np.random.Generator, canvas: Canvas, plant: _Plant) -> None:
    """Blades of grass that rise from the ground."""
    radius_px = plant.radius_px
    for _ in range(int(np.clip(radius_px * BLADES_PER_PX, MIN_BLADES, MAX_BLADES))):
        foot_px = plant.x_px + random.normal(0, radius_px * BLADE_FOOT)
        length_px = radius_px * random.uniform(*BLADE_LENGTH)
        tip_x = foot_px + random.normal(0, length_px * BLADE_LEAN)
        rise_px = length_px * max(MIN_BLADE_RISE, 1 - plant.squash)
        tip_y = plant.y_px - rise_px + random.normal(0, length_px * BLADE_UNEVEN)
        colour = shaded(plant.colour, random.uniform(*SHADE))
        draw_line(canvas, (foot_px, plant.y_px), (tip_x, tip_y), colour, radius_px * BLADE_THICKNESS)


def _draw_round(random: np.random.Generator, canvas: Canvas, plant: _Plant) -> None:
    """A closed canopy, with a lighter or darker part where it is large enough."""
    radius_px, squash, aspect = plant.radius_px, plant.squash, random.uniform(*ROUND_ASPECT)
    middle_y = plant.y_px - plant.lift_px / 2
    radii = radius_px * aspect, (radius_px * max(squash, MIN_ROUND_SQUASH) + plant.lift_px / 2) / aspect
    fill_ellipse(canvas, (plant.x_px, middle_y), radii, random.uniform(*ROUND_TURN_DEG), plant.colour)
    if radius_px <= MIN_HIGHLIGHT_PX:
        return
    aside_px = random.normal(0, radius_px * HIGHLIGHT_ASIDE)
    place = plant.x_px + aside_px, middle_y - radius_px * HIGHLIGHT_RISE * squash
    wide, high = HIGHLIGHT_RADII
    radii = radius_px * wide, radius_px * high * max(squash, MIN_HIGHLIGHT_SQUASH)
    angle_deg, shade = random.uniform(0, 180), random.uniform(*HIGHLIGHT_SHADE)
    fill_ellipse(canvas, place, radii, angle_deg, shaded(plant.colour, shade))
