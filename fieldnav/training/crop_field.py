"""A field of crop rows on a canvas, with the courses of its rows and what hides them."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.training.canvas import (
    HEIGHT_PX,
    WIDTH_PX,
    Canvas,
    Colour,
    Coverage,
    Range,
    blend,
    chance,
    fill_ellipse,
)
from fieldnav.training.colours import foliage_colour, soil_colour
from fieldnav.training.field_cover import hide_parts
from fieldnav.training.ground_camera import Floats, GroundCamera, Projected, draw_camera
from fieldnav.training.ground_cover import draw_stones, log_normal, scatter
from fieldnav.training.plants import SHAPES, PlantLook, PlantShape, any_shape, draw_plants
from fieldnav.training.surfaces import draw_region, textured
from fieldnav.training.truth import RowCourse

NEAR, FAR = -6.0, 60.0  # row spacings along the rows
ROWS = np.arange(-40, 41)
COURSE_Y = np.concatenate([np.arange(NEAR, 8, 0.1), np.arange(8, 20, 0.3), np.arange(20, FAR, 1.0)])
"""Where along the rows their courses are drawn: dense nearby."""

GROUND_STRENGTH: Range = (0.05, 0.45)
STAIN_SHARE, STAIN_STRENGTH, STAIN_OPACITY = 0.25, 0.3, (0.3, 1.0)

MISSING_SHARES = (0.0, 0.05, 0.15)  # of the rows
TRAMLINE_SHARE, TRAMLINE_ROWS, TRAMLINE_WIDTH = 0.25, (34, 47), (1, 3)  # numbers of rows: from, and below
UNEVEN = (0.01, 0.03, 0.07)  # deviations of the rows from even spacing
JOIN_SHARE, JOIN_ROWS, JOIN = 0.15, (-3, 4), (-0.35, 0.5)  # two passes of the drill, too wide or too narrow
TRACKED_SHARE, TRACK_SHARE = 0.3, 0.5  # of the fields; of their inter-rows
TRACK_ASIDE, TRACK_WIDTH, TRACK_SHADE, TRACK_BLUR_PX = (0.4, 0.6), 0.15, (0.75, 0.95), 1.2
MIN_TRACK_SCALE_PX, TRACK_MARGINS_PX = 4.0, (500.0, 200.0, 400.0)

SHAPE_SHARES = (0.35, 0.4, 0.25)  # of SHAPES
USUAL_RADIUS_SHARE, USUAL_RADIUS, LUSH_RADIUS = 0.7, (0.05, 0.34), (0.3, 0.5)
DENSE_SHARE, DENSE_STEP, SPARSE_STEP = 0.7, (0.5, 1.3), (1.0, 4.0)  # plant to plant, in diameters
MIN_STEP, MAX_GRASS_STEP, MAX_GRASS_RADIUS = 0.08, 0.35, 0.25
STEP_SPREAD = 0.15
GAP_SHARES = (0.0, 0.1, 0.25, 0.45)  # of the plants that failed
MAX_RUNS, RUN_FROM, RUN_LENGTH = 3, (-2.0, 20.0), (0.5, 4.0)  # stretches without plants
SCATTER, MIN_SCATTER = (0.0, 0.35), 0.005  # across the row, in radii; in row spacings
COLOUR_SPREAD: Range = (0.04, 0.16)
HEIGHTS = (0.0, 0.0, 0.5, 1.5, 3.0)  # in radii
ENDING_SHARE, END = 0.25, (8.0, 60.0)  # fields whose rows end ahead
STANDS, STAND_LIMITS = (0.05, 0.2), (0.3, 1.6)  # deviations of the plants' size from row to row
RADIUS_SPREAD = 0.2
MAX_PLANTS = 1800  # the nearest; those beyond are smaller than a pixel
MIN_PLANT_SCALE_PX, PLANT_MARGINS_PX = 1.6, (60.0, 40.0, 80.0)
MIN_COURSE_SCALE_PX = 0.8

WEEDLESS_UP_TO, FEW_WEEDS_UP_TO, FEW_WEEDS, MANY_WEEDS = 0.4, 0.75, (5, 80), (80, 500)
WEEDS_ASIDE, WEED_RADIUS, WEED_SPREAD = 12.0, (0.2, 0.8), 0.4  # radius in that of the crop
WEED_OWN_COLOUR_SHARE = 0.5
SHADOWED_SHARE, SHADOW_SHIFT, SHADOW_OPACITY, SHADOW_SHADE = 0.35, 0.8, 0.65, 0.35
MIN_SHADOW_PX, MIN_SHADOW_SQUASH = 1.0, 0.3


@dataclass(frozen=True, slots=True)
class CropField:
    """A drawn field; `hidden`: how far something covers the rows."""

    canvas: Canvas
    rows: list[RowCourse]
    hidden: Coverage


@dataclass(frozen=True, slots=True)
class _Sowing:
    """How a field was sown and came up; lengths in row spacings, arrays of shape (rows,).

    offset: of each row from even spacing; missing: rows without plants; stand: size of each row's plants over
    the usual; step: from plant to plant; scatter: across the row; gaps: share of plants that failed;
    end: where the rows end.
    """

    offset: Floats
    missing: NDArray[np.bool_]
    stand: Floats
    look: PlantLook
    radius: float
    step: float
    scatter: float
    gaps: float
    end: float


def draw_crop_field(random: np.random.Generator) -> CropField:
    """A field seen by some camera: its ground, weeds, crop, and what stands before it."""
    camera, soil = draw_camera(random), soil_colour(random)
    canvas = textured(random, soil, random.uniform(*GROUND_STRENGTH))
    if chance(random, STAIN_SHARE):
        stain = textured(random, soil_colour(random), STAIN_STRENGTH)
        blend(canvas, stain, draw_region(random) * random.uniform(*STAIN_OPACITY))
    missing, offset = _draw_spacing(random)
    if chance(random, TRACKED_SHARE):
        canvas = _draw_tracks(random, canvas, camera, soil)
    draw_stones(random, canvas, camera, soil)
    sowing = _draw_sowing(random, missing, offset)
    places, radii = _grow_crop(random, camera, sowing)
    _draw_weeds(random, canvas, camera, sowing)
    if len(places):
        canvas = _draw_shadows(random, canvas, places, radii, soil)
        order = places.far_to_near()
        draw_plants(random, canvas, places[order], radii[order], sowing.look)
    hidden = hide_parts(random, canvas, camera)
    return CropField(canvas, _courses(camera, sowing), hidden)


def _draw_spacing(random: np.random.Generator) -> tuple[NDArray[np.bool_], Floats]:
    """Which rows are missing, and how far each lies from even spacing."""
    missing = random.random(len(ROWS)) < random.choice(MISSING_SHARES)
    if chance(random, TRAMLINE_SHARE):
        first = int(random.integers(*TRAMLINE_ROWS))
        missing[first : first + int(random.integers(*TRAMLINE_WIDTH))] = True
    offset = random.normal(0, random.choice(UNEVEN), len(ROWS))
    if chance(random, JOIN_SHARE):
        offset += (random.integers(*JOIN_ROWS) < ROWS) * random.uniform(*JOIN)
    return missing, offset


def _draw_tracks(random: np.random.Generator, canvas: Canvas, camera: GroundCamera, soil: Colour) -> Canvas:
    """Darker tracks of wheels or of a hoe between the rows."""
    for row in ROWS:
        if chance(random, TRACK_SHARE):
            continue
        track = camera.project(np.full(len(COURSE_Y), row + random.uniform(*TRACK_ASIDE)), COURSE_Y)
        track = track[track.within(MIN_TRACK_SCALE_PX, *TRACK_MARGINS_PX)]
        points = np.stack([track.x_px, track.y_px], axis=-1).astype(np.int32)
        for start, end, scale_px in zip(points[:-1], points[1:], track.scale_px[:-1], strict=True):
            colour = soil * random.uniform(*TRACK_SHADE)
            cv2.line(canvas, start, end, colour.tolist(), max(1, int(scale_px * TRACK_WIDTH)))
    return np.asarray(cv2.GaussianBlur(canvas, (0, 0), TRACK_BLUR_PX), np.float32)


def _draw_sowing(random: np.random.Generator, missing: NDArray[np.bool_], offset: Floats) -> _Sowing:
    shape = SHAPES[random.choice(len(SHAPES), p=SHAPE_SHARES)]
    colour = foliage_colour(random)
    radius = random.uniform(*(USUAL_RADIUS if chance(random, USUAL_RADIUS_SHARE) else LUSH_RADIUS))
    diameters = random.uniform(*(DENSE_STEP if chance(random, DENSE_SHARE) else SPARSE_STEP))
    step = max(diameters * radius * 2, MIN_STEP)
    gaps = random.choice(GAP_SHARES)
    across = random.uniform(*SCATTER) * radius + MIN_SCATTER
    look = PlantLook(shape, colour, random.uniform(*COLOUR_SPREAD), random.choice(HEIGHTS))
    grass = shape is PlantShape.GRASS
    end = random.uniform(*END) if chance(random, ENDING_SHARE) else np.inf
    return _Sowing(
        offset=offset,
        missing=missing,
        stand=np.clip(1 + random.normal(0, random.choice(STANDS), len(ROWS)), *STAND_LIMITS),
        look=look,
        radius=min(radius, MAX_GRASS_RADIUS) if grass else radius,
        step=min(step, MAX_GRASS_STEP) if grass else step,
        scatter=across,
        gaps=gaps,
        end=end,
    )


def _grow_crop(
    random: np.random.Generator, camera: GroundCamera, sowing: _Sowing
) -> tuple[Projected, Floats]:
    """The plants that came up and are seen, at most MAX_PLANTS, and their radii in row spacings."""
    grown = [_grow_row(random, camera, sowing, int(number)) for number in np.flatnonzero(~sowing.missing)]
    places = Projected(
        np.concatenate([row.x_px for row, _ in grown]),
        np.concatenate([row.y_px for row, _ in grown]),
        np.concatenate([row.scale_px for row, _ in grown]),
        np.concatenate([row.squash for row, _ in grown]),
    )
    radii = np.concatenate([radius for _, radius in grown])
    if len(places) > MAX_PLANTS:
        nearest = np.argsort(-places.scale_px)[:MAX_PLANTS]
        places, radii = places[nearest], radii[nearest]
    return places, radii


def _grow_row(
    random: np.random.Generator, camera: GroundCamera, sowing: _Sowing, number: int
) -> tuple[Projected, Floats]:
    count = int((min(FAR, sowing.end) - NEAR) / sowing.step)
    y = NEAR + np.arange(count) * sowing.step + random.normal(0, sowing.step * STEP_SPREAD, count)
    x = ROWS[number] + sowing.offset[number] + random.normal(0, sowing.scatter, count)
    places = camera.project(x, y)
    stands = places.within(MIN_PLANT_SCALE_PX, *PLANT_MARGINS_PX) & (random.random(count) > sowing.gaps)
    for _ in range(random.integers(0, MAX_RUNS) if sowing.gaps else 0):
        start = random.uniform(*RUN_FROM)
        stands &= ~((y > start) & (y < start + random.uniform(*RUN_LENGTH)))
    places = places[stands]
    usual = sowing.radius * sowing.stand[number]
    return places, usual * np.exp(random.normal(0, RADIUS_SPREAD, len(places)))


def _draw_weeds(random: np.random.Generator, canvas: Canvas, camera: GroundCamera, sowing: _Sowing) -> None:
    """Weeds of one kind anywhere on most fields, some in the crop's own colour."""
    kind = random.random()
    if kind < WEEDLESS_UP_TO:
        return
    count = int(random.integers(*(FEW_WEEDS if kind < FEW_WEEDS_UP_TO else MANY_WEEDS)))
    places = scatter(random, camera, count, WEEDS_ASIDE)
    median = sowing.radius * random.uniform(*WEED_RADIUS)
    radii = log_normal(random, median, WEED_SPREAD, len(places))
    shape = any_shape(random)
    colour = foliage_colour(random) if chance(random, WEED_OWN_COLOUR_SHARE) else sowing.look.colour
    draw_plants(random, canvas, places, radii, PlantLook(shape, colour, sowing.look.colour_spread, 0.0))


def _draw_shadows(
    random: np.random.Generator, canvas: Canvas, places: Projected, radii: Floats, soil: Colour
) -> Canvas:
    """Shadows of the crop on the ground, all to the same side, on some fields."""
    if not chance(random, SHADOWED_SHARE):
        return canvas
    aside, below = random.normal(0, SHADOW_SHIFT, 2)
    radii_px = radii * places.scale_px
    x = places.x_px + aside * radii_px
    y = places.y_px + abs(below) * radii_px * places.squash
    high_px = radii_px * np.maximum(places.squash, MIN_SHADOW_SQUASH)
    shadowed = canvas.copy()
    for number in np.flatnonzero(radii_px > MIN_SHADOW_PX):
        size = radii_px[number], high_px[number]
        fill_ellipse(shadowed, (x[number], y[number]), size, 0, soil * SHADOW_SHADE)
    return canvas * (1 - SHADOW_OPACITY) + shadowed * SHADOW_OPACITY


def _courses(camera: GroundCamera, sowing: _Sowing) -> list[RowCourse]:
    """The centres of the rows up to their end, where they are in front of the camera and near the canvas."""
    y = COURSE_Y[sowing.end > COURSE_Y]
    courses = []
    for number in np.flatnonzero(~sowing.missing):
        course = camera.project(np.full(len(y), ROWS[number] + sowing.offset[number]), y)
        course = course[course.within(MIN_COURSE_SCALE_PX, WIDTH_PX, HEIGHT_PX, HEIGHT_PX)]
        courses.append(RowCourse(course.x_px, course.y_px, course.scale_px))
    return courses
