"""Images without rows: ground without order, ordinary scenes, and single things that could pass for a row."""

import cv2
import numpy as np

from fieldnav.training.canvas import (
    HEIGHT_PX,
    WIDTH_PX,
    X_PX,
    Y_PX,
    Canvas,
    Coverage,
    Range,
    blend,
    chance,
    draw_line,
    fill_ellipse,
    fill_polygon,
    log_uniform,
    shaded,
    smooth_noise,
    soften,
)
from fieldnav.training.colours import any_colour, foliage_colour, foliage_or_any, soil_colour
from fieldnav.training.dead_leaves import any_surface, draw_dead_leaves
from fieldnav.training.ground_camera import draw_camera
from fieldnav.training.ground_cover import draw_stones, log_normal, scatter
from fieldnav.training.plants import PlantLook, any_shape, draw_plants
from fieldnav.training.surfaces import COVER_OCTAVES, bare_ground, draw_region, draw_sky, foliage, textured

GROUND_STRENGTH: Range = (0.05, 0.6)
FOLIAGE_PATCHES, FOLIAGE_PATCH_SHARE, MEADOW_SHARE = 2, 0.3, 0.15
PLANTS, PLANTS_ASIDE = (0, 15, 60, 300, 800), 15.0
PLANT_RADIUS, RADIUS_SPREAD, COLOUR_SPREAD = (0.03, 0.25), 0.5, 0.1  # row spacings; deviations
GROUND_SKY_SHARE = 0.4
SKY_SHARE, SKY_HEIGHTS = 0.3, (0.05, 0.6)  # of dead leaves, single things and scenes

SCENE_LAYERS, SCENE_SHAPES = (1, 7), (0, 25)  # from, and below
SHAPE_FOLIAGE_SHARE, SHAPE_PX = 0.4, (2.0, 50.0)
ELLIPSES_UP_TO, POLYGONS_UP_TO, SLENDER = 0.4, 0.7, (0.2, 1.2)
CORNERS, LINE_REACH, LINE_PX = (3, 7), 2.0, (1, 7)
STRIPED_SHARE, STRIPES, STRIPE_LEVEL, STRIPE_PATCH_SHARE = 0.3, (3.0, 20.0), (-0.5, 0.8), 0.6
STRIPE_SATURATION, STRIPE_STRENGTH, STRIPE_BLUR_PX, STRIPE_OPACITY = (0.0, 160.0), 0.1, 0.8, (0.4, 1.0)
SCENE_SKY_SHARE, SCENE_SKY_HEIGHTS = 0.4, (0.1, 0.7)
WOODED_SHARE, TREES, TREE_PX, TREE_HEIGHTS, TREE_SHADE = 0.3, (1, 9), (6.0, 40.0), (0.2, 0.8), (0.4, 1.0)
LEAF_CLUSTERS, CLUSTER_SPREAD, CLUSTER_RADIUS, CLUSTER_SHADE = 25, 0.4, (0.08, 0.3), (0.5, 1.4)
TRUNK_COLOUR, TRUNK_LENGTH, TRUNK_THICKNESS = (30, 45, 60), 1.5, 0.1  # lengths in the crown's radii

BEFORE_SOIL_SHARE, BEFORE_FOLIAGE_SHARE = 0.5, 0.5  # of the grounds; the latter of those that are not soil
BEFORE_SATURATION, BEFORE_VALUE, BEFORE_STRENGTH = (0.0, 200.0), (30.0, 230.0), (0.05, 0.5)
BEFORE_LEAVES_SHARE = 0.5
UPRIGHTS, UPRIGHT_PX, UPRIGHT_LEAN = (1, 4), (2.0, 40.0), (0.0, 0.6)
UPRIGHT_TOP, UPRIGHT_BOTTOM = (-20.0, 0.6 * HEIGHT_PX), (0.5 * HEIGHT_PX, HEIGHT_PX + 20.0)
CORNER_SPREAD_PX, RAGGED_SHARE, RAGGED_BLUR_PX, RAGGED, RAGGED_LEVEL = 2.0, 0.5, 3.0, 0.15, 0.5
UPRIGHT_BLUR_PX = 0.7


def draw_bare_field(random: np.random.Generator) -> Canvas:
    """Ground with stones and plants anywhere but in rows."""
    canvas, camera = bare_ground(random, GROUND_STRENGTH), draw_camera(random)
    for _ in range(FOLIAGE_PATCHES):
        if chance(random, FOLIAGE_PATCH_SHARE):
            blend(canvas, foliage(random), draw_region(random))
    if chance(random, MEADOW_SHARE):
        canvas = foliage(random)
    draw_stones(random, canvas, camera, soil_colour(random))
    count = int(random.choice(PLANTS))
    if count:
        places = scatter(random, camera, count, PLANTS_ASIDE)
        radii = log_normal(random, random.uniform(*PLANT_RADIUS), RADIUS_SPREAD, len(places))
        look = PlantLook(any_shape(random), foliage_colour(random), COLOUR_SPREAD, 0.0)
        draw_plants(random, canvas, places, radii, look)
    if chance(random, GROUND_SKY_SHARE) and camera.horizon_px > 0:
        draw_sky(random, canvas, camera.horizon_px)
    return canvas


def draw_leaves(random: np.random.Generator) -> Canvas:
    """Shapes of all sizes, perhaps under a sky."""
    return _perhaps_under_sky(random, draw_dead_leaves(random))


def draw_scene(random: np.random.Generator) -> Canvas:
    """A scene as of an ordinary photograph: surfaces, shapes of any colour, stripes, sky and trees."""
    canvas = any_surface(random)
    for _ in range(random.integers(*SCENE_LAYERS)):
        blend(canvas, any_surface(random), draw_region(random))
    for _ in range(random.integers(*SCENE_SHAPES)):
        _draw_shape(random, canvas)
    if chance(random, STRIPED_SHARE):
        _draw_stripes(random, canvas)
    if chance(random, SCENE_SKY_SHARE):
        draw_sky(random, canvas, random.uniform(*SCENE_SKY_HEIGHTS) * HEIGHT_PX)
    if chance(random, WOODED_SHARE):
        for _ in range(random.integers(*TREES)):
            _draw_tree(random, canvas)
    return _perhaps_under_sky(random, canvas)


def draw_uprights(random: np.random.Generator) -> Canvas:
    """One to three upright or leaning things that are no row: trunks, posts, tracks, a strip of grass."""
    canvas = _draw_background(random)
    for _ in range(random.integers(*UPRIGHTS)):
        coverage = _draw_upright(random)
        blend(canvas, any_surface(random), soften(coverage, UPRIGHT_BLUR_PX))
    return _perhaps_under_sky(random, canvas)


def _perhaps_under_sky(random: np.random.Generator, canvas: Canvas) -> Canvas:
    if chance(random, SKY_SHARE):
        draw_sky(random, canvas, random.uniform(*SKY_HEIGHTS) * HEIGHT_PX)
    return canvas


def _draw_shape(random: np.random.Generator, canvas: Canvas) -> None:
    """An ellipse, a polygon or a line."""
    colour = foliage_or_any(random, SHAPE_FOLIAGE_SHARE)
    x, y = random.uniform(0, WIDTH_PX), random.uniform(0, HEIGHT_PX)
    size_px = log_uniform(random, SHAPE_PX)
    kind = random.random()
    if kind < ELLIPSES_UP_TO:
        radii = size_px, size_px * random.uniform(*SLENDER)
        fill_ellipse(canvas, (x, y), radii, random.uniform(0, 180), colour)
    elif kind < POLYGONS_UP_TO:
        corners = np.array([x, y]) + random.normal(0, size_px, (random.integers(*CORNERS), 2))
        fill_polygon(canvas, corners, colour.tolist())
    else:
        right, down = random.normal(0, size_px * LINE_REACH, 2)
        draw_line(canvas, (x, y), (x + right, y + down), colour, int(random.integers(*LINE_PX)))


def _draw_stripes(random: np.random.Generator, canvas: Canvas) -> None:
    """Fences, windows, tiles: parallel stripes that do not converge as rows on the ground do."""
    angle, number = random.uniform(0, np.pi), random.uniform(*STRIPES)
    distance = (X_PX * np.cos(angle) + Y_PX * np.sin(angle)) / WIDTH_PX * number
    stripes = (np.cos(2 * np.pi * distance) > random.uniform(*STRIPE_LEVEL)).astype(np.float32)
    if chance(random, STRIPE_PATCH_SHARE):
        stripes *= draw_region(random)
    surface = textured(random, any_colour(random, STRIPE_SATURATION), STRIPE_STRENGTH)
    blend(canvas, surface, soften(stripes, STRIPE_BLUR_PX) * random.uniform(*STRIPE_OPACITY))


def _draw_tree(random: np.random.Generator, canvas: Canvas) -> None:
    x, radius_px = random.uniform(0, WIDTH_PX), random.uniform(*TREE_PX)
    y = random.uniform(*TREE_HEIGHTS) * HEIGHT_PX
    colour = foliage_colour(random) * random.uniform(*TREE_SHADE)
    for _ in range(LEAF_CLUSTERS):
        right, down = random.normal(0, radius_px * CLUSTER_SPREAD, 2)
        wide, high = random.uniform(*CLUSTER_RADIUS, 2) * radius_px
        own = shaded(colour, random.uniform(*CLUSTER_SHADE))
        fill_ellipse(canvas, (x + right, y + down), (wide, high), 0, own)
    thickness = max(1, int(radius_px * TRUNK_THICKNESS))
    cv2.line(canvas, (int(x), int(y)), (int(x), int(y + radius_px * TRUNK_LENGTH)), TRUNK_COLOUR, thickness)


def _draw_background(random: np.random.Generator) -> Canvas:
    if chance(random, BEFORE_SOIL_SHARE):
        colour = soil_colour(random)
    elif chance(random, BEFORE_FOLIAGE_SHARE):
        colour = foliage_colour(random)
    else:
        colour = any_colour(random, BEFORE_SATURATION, BEFORE_VALUE)
    canvas = textured(random, colour, random.uniform(*BEFORE_STRENGTH))
    return draw_dead_leaves(random) if chance(random, BEFORE_LEAVES_SHARE) else canvas


def _draw_upright(random: np.random.Generator) -> Coverage:
    """A strip from above to below, with straight or ragged edges."""
    top_x, bottom_x = random.uniform(0, WIDTH_PX, 2)
    bottom_x = top_x + (bottom_x - top_x) * random.uniform(*UPRIGHT_LEAN)
    top_half, bottom_half = random.uniform(*UPRIGHT_PX, 2) / 2
    top_y, bottom_y = random.uniform(*UPRIGHT_TOP), random.uniform(*UPRIGHT_BOTTOM)
    corners = np.array(
        [
            [top_x - top_half, top_y],
            [top_x + top_half, top_y],
            [bottom_x + bottom_half, bottom_y],
            [bottom_x - bottom_half, bottom_y],
        ]
    )
    coverage = np.zeros((HEIGHT_PX, WIDTH_PX), np.float32)
    fill_polygon(coverage, corners + random.normal(0, CORNER_SPREAD_PX, corners.shape), (1.0,))
    if not chance(random, RAGGED_SHARE):
        return coverage
    ragged = soften(coverage, RAGGED_BLUR_PX) + smooth_noise(random, COVER_OCTAVES) * RAGGED
    return (ragged > RAGGED_LEVEL).astype(np.float32)
