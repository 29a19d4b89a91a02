"""What lies and grows on the ground without order: stones and weeds."""

import numpy as np

from fieldnav.training.canvas import Canvas, Colour, Range, chance, fill_ellipse, log_uniform, shaded
from fieldnav.training.ground_camera import Floats, GroundCamera, Projected

SPARE = 3  # points drawn for each one wanted, since the camera does not see all
ALONG: Range = (-5.0, 40.0)  # row spacings from the camera
MIN_SCALE_PX = 2.0  # farther away, single things do not show
MARGIN_PX = 30.0  # a plant whose middle lies outside may reach into the image

STONELESS_SHARE = 0.3
STONES: Range = (20, 900)
STONES_ASIDE = 14.0
STONES_AHEAD, STONES_BEHIND = (1.0, 50.0), 7.0  # denser nearby, where single stones show
STONE_MARGIN_PX = 10.0
STONE_RADIUS, RADIUS_SPREAD = (0.008, 0.05), 0.5  # row spacings; deviation of the logarithm
MIN_STONE_PX, MAX_STONE_PX, MIN_SHADED_PX = 0.35, 25.0, 1.0
STONE_LIGHT, LIGHT_SPREAD = (1.1, 2.4), (0.05, 0.4)
SOIL_TINT = 0.4  # share of the soil's colour in that of the stones, the rest is grey
FLATNESS, TURN_DEG, MIN_STONE_SQUASH = (0.5, 1.0), (-30.0, 30.0), 0.45
SHADOW, SHADOW_ASIDE, SHADOW_BELOW = 0.45, 0.25, 0.35


def scatter(random: np.random.Generator, camera: GroundCamera, count: int, half_width: float) -> Projected:
    """At most `count` points spread evenly over the ground, the far ones first."""
    x = random.uniform(-half_width, half_width, count * SPARE)
    y = random.uniform(*ALONG, count * SPARE)
    return _seen(camera.project(x, y), count, MARGIN_PX)


def log_normal(random: np.random.Generator, median: float, spread: float, count: int) -> Floats:
    """Sizes about a median, shape (count,)."""
    return np.exp(random.normal(np.log(median), spread, count))


def draw_stones(random: np.random.Generator, canvas: Canvas, camera: GroundCamera, soil: Colour) -> None:
    """Draw stones and clods on most grounds, each with its shadow; changes `canvas`."""
    if chance(random, STONELESS_SHARE):
        return
    places = _stone_places(random, camera, int(log_uniform(random, STONES)))
    median = log_uniform(random, STONE_RADIUS)
    colour = (soil * SOIL_TINT + soil.mean() * (1 - SOIL_TINT)) * random.uniform(*STONE_LIGHT)
    spread = random.uniform(*LIGHT_SPREAD)
    for number in range(len(places)):
        radius_px = median * np.exp(random.normal(0, RADIUS_SPREAD)) * places.scale_px[number]
        if radius_px >= MIN_STONE_PX:
            place = places.x_px[number], places.y_px[number]
            radii = _stone_radii(random, radius_px, places.squash[number])
            own = shaded(colour, 1 + random.normal(0, spread))
            _draw_stone(random, canvas, place, radii, own, soil)


def _stone_places(random: np.random.Generator, camera: GroundCamera, count: int) -> Projected:
    x = random.uniform(-STONES_ASIDE, STONES_ASIDE, count * SPARE)
    nearest, farthest = np.log(STONES_AHEAD)
    y = np.exp(random.uniform(nearest, farthest, count * SPARE)) - STONES_BEHIND
    return _seen(camera.project(x, y), count, STONE_MARGIN_PX)


def _seen(points: Projected, count: int, margin_px: float) -> Projected:
    """At most `count` of the points that show, the far ones first."""
    points = points[points.within(MIN_SCALE_PX, margin_px, margin_px, margin_px)][:count]
    return points[points.far_to_near()]


def _stone_radii(random: np.random.Generator, radius_px: float, squash: float) -> tuple[float, float]:
    radius_px = min(radius_px, MAX_STONE_PX)
    return radius_px, radius_px * random.uniform(*FLATNESS) * max(squash, MIN_STONE_SQUASH)


def _draw_stone(
    random: np.random.Generator,
    canvas: Canvas,
    place: tuple[float, float],
    radii: tuple[float, float],
    colour: Colour,
    soil: Colour,
) -> None:
    angle_deg = random.uniform(*TURN_DEG)
    if radii[0] > MIN_SHADED_PX:
        below = place[0] + radii[0] * SHADOW_ASIDE, place[1] + radii[1] * SHADOW_BELOW
        fill_ellipse(canvas, below, radii, angle_deg, soil * SHADOW)
    fill_ellipse(canvas, place, radii, angle_deg, colour)
