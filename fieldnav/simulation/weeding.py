"""Weeds: some everywhere, some in patches or in lines, some as large as the crop, few on the headland."""

import numpy as np

from fieldnav.messages import Floats
from fieldnav.settings.crop import CropProfile, Plants
from fieldnav.settings.field import FieldSettings
from fieldnav.simulation.centreline import Centreline
from fieldnav.simulation.rowlines import MARGIN_M, RowLines
from fieldnav.simulation.sowing import CROP, VARIANTS
from fieldnav.simulation.stand import NO_ROW, Stand
from fieldnav.simulation.streams import Stream, random_stream
from fieldnav.simulation.weedlines import weed_lines

BESIDE_M = 1.6  # of weedy ground beyond the outermost rows, as far as a camera looks
PATCH_WEEDS = 25.0  # weeds in a patch, on average
PATCH_RADIUS_M = (0.15, 0.5)  # standard deviation of the weeds of one patch
PATCH_KINSHIP = 0.85  # share of a patch's weeds that are of its main species
HEIGHT_OVER_WIDTH = (0.3, 0.9)
LARGE_WIDTH, LARGE_HEIGHT = (0.7, 1.1), (0.6, 1.0)  # of a large weed over the crop's


def grow_weeds(
    field: FieldSettings, crop: CropProfile, line: Centreline, rows: RowLines, species: int
) -> Stand:
    """All weeds of the field and its headlands; their species are numbered from CROP + 1."""
    random = random_stream(field.seed, Stream.WEED_PLACE)
    across = (rows.row_n_m.min() - BESIDE_M, rows.row_n_m.max() + BESIDE_M)
    strips = [
        ((-MARGIN_M, 0.0), field.weeds.headland_per_m2),
        ((0.0, field.length_m), field.weeds.per_m2 * (1 - field.weeds.lines)),
        ((field.length_m, field.length_m + MARGIN_M), field.weeds.headland_per_m2),
    ]
    drawn = [_strip(random, s, across, density, field.weeds.patches, species) for s, density in strips]
    drawn.append(weed_lines(field, rows, across, species))
    places, kinds = np.vstack([d[0] for d in drawn]), np.concatenate([d[1] for d in drawn])
    xy = line.position(places[:, 0], places[:, 1])
    return _looks(field, crop.plants, xy, kinds)


def _strip(
    random: np.random.Generator,
    s_m: tuple[float, float],
    n_m: tuple[float, float],
    per_m2: float,
    patches: float,
    species: int,
) -> tuple[Floats, Floats]:
    """Weeds of a strip of ground: (s, n), shape (count, 2), and species, shape (count,)."""
    lower, upper = np.array([s_m[0], n_m[0]]), np.array([s_m[1], n_m[1]])
    expected = per_m2 * float(np.prod(upper - lower))
    alone = random.uniform(lower, upper, (random.poisson(expected * (1 - patches)), 2))
    alone_kinds = random.integers(0, species, len(alone))
    clusters = random.poisson(expected * patches / PATCH_WEEDS)
    patch = np.repeat(np.arange(clusters), random.poisson(PATCH_WEEDS, clusters))
    middles, radii = random.uniform(lower, upper, (clusters, 2)), random.uniform(*PATCH_RADIUS_M, clusters)
    spread = middles[patch] + random.standard_normal((patch.size, 2)) * radii[patch, None]
    # a weed that falls outside comes back in by reflection, so the density asked for is kept
    spread = np.clip(np.where(spread < lower, 2 * lower - spread, spread), None, upper * 2 - lower)
    spread = np.clip(np.where(spread > upper, 2 * upper - spread, spread), lower, upper)
    main_kind = random.integers(0, species, clusters)[patch]
    any_kind = random.integers(0, species, patch.size)
    kinds = np.where(random.random(patch.size) < PATCH_KINSHIP, main_kind, any_kind)
    return np.vstack([alone, spread]), np.concatenate([alone_kinds, kinds])


def _looks(field: FieldSettings, crop: Plants, xy: Floats, kinds: Floats) -> Stand:
    """Weeds at `xy` of given species: a share as large as the crop, else sizes even over the logarithm."""
    count = len(xy)
    random = random_stream(field.seed, Stream.WEED_LOOK)
    smallest, largest = field.weeds.size_m
    diameter = smallest * (largest / smallest) ** random.random(count)
    turn, sway = random.uniform(-np.pi, np.pi, (2, count))
    height = diameter * random.uniform(*HEIGHT_OVER_WIDTH, count)
    variant = random.integers(0, VARIANTS, count).astype(np.int32)
    grown = random_stream(field.seed, Stream.WEED_LARGE)
    large = grown.random(count) < field.weeds.large
    return Stand(
        x_m=xy[:, 0],
        y_m=xy[:, 1],
        heading_rad=turn,
        diameter_m=np.where(large, crop.canopy_width_m * grown.uniform(*LARGE_WIDTH, count), diameter),
        height_m=np.where(large, crop.canopy_height_m * grown.uniform(*LARGE_HEIGHT, count), height),
        species=(CROP + 1 + kinds).astype(np.int32),
        variant=variant,
        is_crop=np.zeros(count, bool),
        lane=np.full(count, NO_ROW, np.int32),
        row=np.full(count, NO_ROW, np.int32),
        sway_rad=sway,
    )
