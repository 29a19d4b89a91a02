"""Sowing the crop: every row's plants, with what germination, gaps and nature make of them."""

import numpy as np

from fieldnav.messages import Floats
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.simulation.centreline import Centreline
from fieldnav.simulation.gaps import draw_gaps, outside
from fieldnav.simulation.rowlines import RowLines
from fieldnav.simulation.stand import Stand
from fieldnav.simulation.streams import Stream, random_stream

CROP = 0  # index of the crop among the plan's species
VARIANTS = 14  # differently grown models of each species
SPACING_JITTER = 0.12  # rms, of the distance between two plants in the row
SCATTER_CUT = 2.5  # standard deviations: the drill drops no seed further from its line
SIZE_SPREAD = 0.1  # rms of the logarithm of a plant's size
SIZE_LIMITS = (0.6, 1.3)
LATE_SHARE = 0.04  # plants that came up late
LATE_SIZE = 0.55


def sow_crop(field: FieldSettings, crop: CropProfile, line: Centreline, rows: RowLines) -> Stand:
    """All crop plants of the field."""
    stands = []
    for lane in range(field.lanes):
        random = random_stream(field.seed, Stream.LANE_GAPS, lane)
        gaps = draw_gaps(random, field.gaps.lane_gaps_per_10m, field.gaps.lane_gap_m, field.length_m)
        stands += [_sow_row(field, crop, line, rows, lane, row, gaps) for row in range(crop.rows.per_lane)]
    return Stand.joined(stands)


def _sow_row(
    field: FieldSettings,
    crop: CropProfile,
    line: Centreline,
    rows: RowLines,
    lane: int,
    row: int,
    lane_gaps: Floats,
) -> Stand:
    s = _places(field, crop, rows, lane, row)
    kept = _survivors(field, s, lane, row, lane_gaps)
    place = random_stream(field.seed, Stream.CROP_PLACE, lane, row, 1)
    scatter = np.clip(place.standard_normal(s.size), -SCATTER_CUT, SCATTER_CUT) * field.rows.scatter_m
    xy = line.position(s, rows.row_n(lane, row, s) + scatter)[kept]
    size, look = _sizes(field, s.size, lane, row)
    size, turn, sway, variant = size[kept], *(values[kept] for values in look)
    count = len(size)
    return Stand(
        x_m=xy[:, 0],
        y_m=xy[:, 1],
        heading_rad=turn,
        diameter_m=crop.plants.canopy_width_m * size,
        height_m=crop.plants.canopy_height_m * size,
        species=np.full(count, CROP, np.int32),
        variant=variant.astype(np.int32),
        is_crop=np.ones(count, bool),
        lane=np.full(count, lane, np.int32),
        row=np.full(count, row, np.int32),
        sway_rad=sway,
    )


def _places(field: FieldSettings, crop: CropProfile, rows: RowLines, lane: int, row: int) -> Floats:
    """Where along its row each seed lies; the first and the last exactly at the row's ends."""
    start, end = rows.start_m[lane, row], rows.end_m[lane, row]
    count = max(2, round((end - start) / crop.plants.spacing_m) + 1)
    random = random_stream(field.seed, Stream.CROP_PLACE, lane, row)
    jitter = random.standard_normal(count) * SPACING_JITTER * crop.plants.spacing_m
    jitter[[0, -1]] = 0
    return np.asarray(np.clip(np.linspace(start, end, count) + jitter, start, end))


def _survivors(
    field: FieldSettings, s: Floats, lane: int, row: int, lane_gaps: Floats
) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Which seeds of a row came up. The first and the last always do: they are the row's ends."""
    random = random_stream(field.seed, Stream.ROW_GAPS, lane, row)
    row_gaps = draw_gaps(random, field.gaps.row_gaps_per_10m, field.gaps.row_gap_m, field.length_m)
    germination = random_stream(field.seed, Stream.GERMINATION, lane, row)
    up = germination.random(s.size) < field.gaps.germination
    up[[0, -1]] = True
    return up & outside(s, row_gaps) & outside(s, lane_gaps)


def _sizes(
    field: FieldSettings, count: int, lane: int, row: int
) -> tuple[Floats, tuple[Floats, Floats, Floats]]:
    """Size relative to the profile's, and (turn, sway phase, variant) of each plant of a row."""
    random = random_stream(field.seed, Stream.CROP_LOOK, lane, row)
    size = np.clip(np.exp(random.standard_normal(count) * SIZE_SPREAD), *SIZE_LIMITS)
    size = np.where(random.random(count) < LATE_SHARE, size * LATE_SIZE, size)
    turn, sway = random.uniform(-np.pi, np.pi, (2, count))
    return size, (turn, sway, random.integers(0, VARIANTS, count).astype(float))
