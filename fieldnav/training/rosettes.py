"""Rosettes of large upright leaves, lit from one side, dark inside, with shadows, as of beet or cabbage."""

from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, radians, sin

import cv2
import numpy as np

from fieldnav.training.canvas import (
    HEIGHT_PX,
    WHITE,
    WIDTH_PX,
    Canvas,
    Colour,
    Range,
    chance,
    draw_line,
    fill_ellipse,
    shaded,
)
from fieldnav.training.ground_camera import Floats, Projected

GROWTH: Range = (1.0, 1.6)  # wider than other plants, since leaves leave gaps
MAX_RADIUS_HEIGHTS = 0.4  # of the image
MIN_SCALE_PX = 1e-3
MIN_RADIUS_PX, MIN_LEAVES_PX, MANY_LEAVES_PX = 0.4, 2.5, 6.0  # to be drawn, with leaves, with all of them
MIN_GLOSS_PX, MIN_VEIN_PX = 5.0, 8.0
HUE_SPREAD = 30.0  # grey levels, for a spread of the brightness of 1
LEAVES, FEW_LEAVES = (6, 14), 4  # from, and below; the fewest of a small plant
SHADOW: Range = (0.1, 0.8)  # brightness of the ground in a plant's shadow
SUN_LOW: Range = (0.7, 2.2)  # length of a shadow, 1 under a sun at 45 degrees, about
CRINKLED_SHARE, CRINKLE, CRINKLE_PX = 0.6, (0.1, 0.5), (0.5, 2.0)  # leaves that are not smooth
NARROW: Range = (0.2, 0.5)  # breadth of a leaf over its length
UPRIGHT: Range = (0.3, 1.6)  # rise of a leaf over its length
GLOSS: Range = (1.0, 1.9)  # brightness of a leaf's ridge
VEIN_SHARE, VEIN_GLOSS, VEIN_LIGHT = 0.5, 1.3, 15.0

SHADOW_ASIDE, SHADOW_BELOW, SHADOW_SQUASH, MIN_SHADOW_SQUASH = 0.7, 0.4, 0.8, 0.3
SMALL_RISE, MIN_SMALL_SQUASH = 0.4, 0.5
HEART_SHARE, HEART_SHADE, HEART_RISE, HEART_RADII = 0.6, 0.35, 0.2, (0.18, 0.14)

TURN_DEG = 12.0  # standard deviation
LENGTH: Range = (0.7, 1.15)
MIN_LEAF_SQUASH = 0.25
LIFT: Range = (0.5, 1.0)
DARK_SIDE, LIT_SIDE, LIT_SPREAD = 0.55, 0.6, (0.7, 1.2)
LEAF_MIDDLE, LEAF_MIDDLE_DOWN, LEAF_LIFT = 0.70, 0.55, 0.75  # of the way from foot to tip
GLOSS_MIDDLE, GLOSS_LIFT = 0.75, 0.80
LEAF_BREADTH: Range = (0.8, 1.3)
GLOSS_RADII, GLOSS_ASIDE = (0.6, 0.45), 0.1


@dataclass(frozen=True, slots=True)
class _Habit:
    """What the rosettes of one field have in common; `light` points to the sun in the image, shape (2,)."""

    light: Floats
    shadow: float
    sun_low: float
    leaves: int
    narrow: float
    upright: float
    gloss: float
    veins: bool


@dataclass(frozen=True, slots=True)
class _Rosette:
    x_px: float
    y_px: float
    radius_px: float
    squash: float
    colour: Colour


def draw_rosettes(
    random: np.random.Generator,
    canvas: Canvas,
    places: Projected,
    radii: Floats,
    colour: Colour,
    spread: float,
) -> None:
    """Draw rosettes of these radii, shape (n,), in row spacings, the far ones first; changes `canvas`."""
    limit = MAX_RADIUS_HEIGHTS * HEIGHT_PX / np.maximum(places.scale_px, MIN_SCALE_PX)
    radii_px = np.minimum(radii * random.uniform(*GROWTH), limit) * places.scale_px
    habit = _draw_habit(random)
    bare = canvas.copy()
    columns = np.stack([places.x_px, places.y_px, radii_px, places.squash], axis=-1)
    for x_px, y_px, radius_px, squash in columns[radii_px >= MIN_RADIUS_PX].tolist():
        own = colour * (1 + random.normal(0, spread)) + random.normal(0, spread * HUE_SPREAD, 3)
        plant = _Rosette(x_px, y_px, radius_px, squash, own.clip(0, WHITE))
        _draw_rosette(random, canvas, habit, plant)
    if chance(random, CRINKLED_SHARE):
        _crinkle(random, canvas, bare)


def _crinkle(random: np.random.Generator, canvas: Canvas, bare: Canvas) -> None:
    """Give what was drawn since `bare` the light and dark of leaves that are not smooth; changes `canvas`."""
    size_px = random.uniform(*CRINKLE_PX)
    grain = cv2.GaussianBlur(random.standard_normal(canvas.shape[:2]).astype(np.float32), (0, 0), size_px)
    light = np.exp(grain / grain.std() * random.uniform(*CRINKLE))
    drawn = np.abs(canvas - bare).max(axis=2) > 1
    canvas *= np.where(drawn, light, 1)[..., None]


def _draw_habit(random: np.random.Generator) -> _Habit:
    light = random.normal(0, 1, 2)
    return _Habit(
        light=light / np.linalg.norm(light),
        shadow=random.uniform(*SHADOW),
        sun_low=random.uniform(*SUN_LOW),
        leaves=int(random.integers(*LEAVES)),
        narrow=random.uniform(*NARROW),
        upright=random.uniform(*UPRIGHT),
        gloss=random.uniform(*GLOSS),
        veins=chance(random, VEIN_SHARE),
    )


def _draw_rosette(random: np.random.Generator, canvas: Canvas, habit: _Habit, plant: _Rosette) -> None:
    """One plant: its shadow, its leaves from back to front, its dark middle."""
    x, y, radius_px = plant.x_px, plant.y_px, plant.radius_px
    rise = habit.upright * (1 - plant.squash)
    if radius_px < MIN_LEAVES_PX:
        radii = radius_px, radius_px * max(plant.squash, MIN_SMALL_SQUASH)
        fill_ellipse(canvas, (x, y - radius_px * SMALL_RISE * rise), radii, 0, plant.colour)
        return
    _draw_shadow(canvas, habit, plant)
    leaves = habit.leaves if radius_px > MANY_LEAVES_PX else max(FEW_LEAVES, habit.leaves // 2)
    directions = random.uniform(0, 360) + 360 * np.arange(leaves) / leaves
    for direction_deg in directions[np.argsort(np.sin(np.radians(directions)))]:
        _draw_leaf(random, canvas, habit, plant, float(direction_deg))
    if chance(random, HEART_SHARE):
        wide, high = HEART_RADII
        middle = x, y - HEART_RISE * radius_px * rise
        fill_ellipse(canvas, middle, (radius_px * wide, radius_px * high), 0, plant.colour * HEART_SHADE)


def _draw_shadow(canvas: Canvas, habit: _Habit, plant: _Rosette) -> None:
    """The shadow on the ground, away from the sun and always before the plant."""
    aside = habit.light[0] * SHADOW_ASIDE * habit.sun_low
    below = abs(habit.light[1]) * SHADOW_BELOW * habit.sun_low
    place = plant.x_px - aside * plant.radius_px, plant.y_px + below * plant.radius_px
    row, column = int(np.clip(plant.y_px, 0, HEIGHT_PX - 1)), int(np.clip(plant.x_px, 0, WIDTH_PX - 1))
    wide_px = plant.radius_px * max(1.0, habit.sun_low * abs(float(habit.light[0])))
    radii = wide_px, plant.radius_px * max(plant.squash, MIN_SHADOW_SQUASH) * SHADOW_SQUASH
    fill_ellipse(canvas, place, radii, 0, canvas[row, column] * habit.shadow)


def _draw_leaf(
    random: np.random.Generator, canvas: Canvas, habit: _Habit, plant: _Rosette, direction_deg: float
) -> None:
    """One leaf from the plant's foot outwards and up, brighter towards the sun."""
    angle = radians(direction_deg + random.normal(0, TURN_DEG))
    length_px = plant.radius_px * random.uniform(*LENGTH)
    right, down = cos(angle) * length_px, sin(angle) * length_px * max(plant.squash, MIN_LEAF_SQUASH)
    lift = habit.upright * length_px * (1 - plant.squash) * random.uniform(*LIFT)
    facing = (cos(angle) * habit.light[0] + sin(angle) * habit.light[1] + 1) / 2
    shade = DARK_SIDE + LIT_SIDE * max(0, facing) * random.uniform(*LIT_SPREAD)
    half_px = max(hypot(right, down - lift) / 2, 1.0)
    turn_deg = degrees(atan2(down - lift, right))
    middle = plant.x_px + right * LEAF_MIDDLE, plant.y_px + down * LEAF_MIDDLE_DOWN - lift * LEAF_LIFT
    radii = half_px, half_px * habit.narrow * random.uniform(*LEAF_BREADTH)
    fill_ellipse(canvas, middle, radii, turn_deg, shaded(plant.colour, shade))
    if plant.radius_px > MIN_GLOSS_PX:
        ridge_x = plant.x_px + right * GLOSS_MIDDLE - habit.light[0] * half_px * GLOSS_ASIDE
        ridge = ridge_x, plant.y_px + down * LEAF_MIDDLE_DOWN - lift * GLOSS_LIFT
        radii = half_px * GLOSS_RADII[0], half_px * habit.narrow * GLOSS_RADII[1]
        fill_ellipse(canvas, ridge, radii, turn_deg, shaded(plant.colour, shade * habit.gloss))
    if habit.veins and plant.radius_px > MIN_VEIN_PX:
        tip = plant.x_px + right, plant.y_px + down - lift
        colour = shaded(plant.colour * (shade * VEIN_GLOSS) + VEIN_LIGHT, 1)
        draw_line(canvas, (plant.x_px, plant.y_px), tip, colour, 1)
