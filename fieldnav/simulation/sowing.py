"""Sowing the crop: every row's plants, with what germination, gaps and nature make of them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.placement import unsown_rows
from fieldnav.simulation.centreline import Centreline
from fieldnav.simulation.emergence import Flags, emerging
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


@dataclass(frozen=True, slots=True)
class Sown:
    """The crop as it came up.

    exists: shape (lanes, rows), which rows have plants; first_m, last_m: the same shape, s of each row's
    first and last plant, of a row without plants where it would have begun and ended.
    """

    plants: Stand
    exists: NDArray[np.bool_]
    first_m: Floats
    last_m: Floats


def sow_crop(field: FieldSettings, crop: CropProfile, line: Centreline, rows: RowLines) -> Sown:
    """All crop plants of the field."""
    exists = np.zeros(rows.start_m.shape, bool)
    first_m, last_m = rows.start_m.copy(), rows.end_m.copy()
    stands = []
    for lane in range(field.lanes):
        n = float(rows.lane_n_m[lane])
        places = {row: _places(field, crop, line, rows, lane, row) for row in _drilled(field, crop, lane)}
        ways = {row: line.way_m(s, n) for row, s in places.items()}
        length_m = float(line.way_m(field.length_m, n))
        for row, up in emerging(field, lane, ways, crop.plants.spacing_m, length_m).items():
            stands.append(_stand(field, crop, line, rows, lane, row, places[row], up))
            if up.any():
                exists[lane, row] = True
                first_m[lane, row], last_m[lane, row] = places[row][up].min(), places[row][up].max()
    return Sown(Stand.joined(stands), exists, first_m, last_m)


def _drilled(field: FieldSettings, crop: CropProfile, lane: int) -> list[int]:
    """The rows of a lane that were sown, counted from 0."""
    if lane + 1 in field.unsown.lanes:
        return []
    left_out = unsown_rows(field, lane + 1)
    return [row for row in range(crop.rows.per_lane) if row + 1 not in left_out]


def _stand(
    field: FieldSettings,
    crop: CropProfile,
    line: Centreline,
    rows: RowLines,
    lane: int,
    row: int,
    s: Floats,
    up: Flags,
) -> Stand:
    """The plants of a row whose seeds lie at `s`, shape (n,), of those that came `up`."""
    place = random_stream(field.seed, Stream.CROP_PLACE, lane, row, 1)
    scatter = np.clip(place.standard_normal(s.size), -SCATTER_CUT, SCATTER_CUT) * field.rows.scatter_m
    xy = line.position(s, rows.row_n(lane, row, s) + scatter)[up]
    size, look = _sizes(field, s.size, lane, row)
    size, turn, sway, variant = size[up], *(values[up] for values in look)
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


def _places(
    field: FieldSettings, crop: CropProfile, line: Centreline, rows: RowLines, lane: int, row: int
) -> Floats:
    """The s of each seed of a row, evenly along the row itself; the first and the last at its very ends."""
    start, end = float(rows.start_m[lane, row]), float(rows.end_m[lane, row])
    n = float(rows.row_n_m[lane, row].mean())
    way_start, way_end = line.way_m([start, end], n)
    count = max(2, round((way_end - way_start) / crop.plants.spacing_m) + 1)
    random = random_stream(field.seed, Stream.CROP_PLACE, lane, row)
    jitter = random.standard_normal(count) * SPACING_JITTER * crop.plants.spacing_m
    jitter[[0, -1]] = 0
    s = line.s_after(np.linspace(way_start, way_end, count) + jitter, n)
    s[[0, -1]] = start, end
    return np.asarray(np.clip(s, start, end))


def _sizes(
    field: FieldSettings, count: int, lane: int, row: int
) -> tuple[Floats, tuple[Floats, Floats, Floats]]:
    """Size relative to the profile's, and (turn, sway phase, variant) of each plant of a row."""
    random = random_stream(field.seed, Stream.CROP_LOOK, lane, row)
    size = np.clip(np.exp(random.standard_normal(count) * SIZE_SPREAD), *SIZE_LIMITS)
    size = np.where(random.random(count) < LATE_SHARE, size * LATE_SIZE, size)
    turn, sway = random.uniform(-np.pi, np.pi, (2, count))
    return size, (turn, sway, random.integers(0, VARIANTS, count).astype(float))
