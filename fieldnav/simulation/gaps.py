"""Stretches of a row, or of a whole lane, where nothing came up: drawn by chance, or placed by the file.

All distances are along the lane, in metres from the field's start.
"""

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.settings.field import ALL_ROWS, FieldSettings
from fieldnav.simulation.streams import Stream, random_stream

ENDS_KEPT_M = 1.0  # of a row at both its ends, so that the row's end is where its last plant stands
PLANTS_BETWEEN_M = 0.5  # at least, between two gaps: two gaps never join to one longer than asked for
CROP_BETWEEN_M = 1.0  # the same between two gaps in all rows: most of what a camera sees at once
PER_M = 10.0  # gaps are counted per this length


def lane_gaps(field: FieldSettings, lane: int, length_m: float) -> Floats:
    """Gaps (start, end) in all rows of a lane of a length, shape (n, 2), in order, apart from each other."""
    placed = placed_gaps(field, lane, ALL_ROWS, length_m)
    random = random_stream(field.seed, Stream.LANE_GAPS, lane)
    settings = field.gaps
    drawn = draw_gaps(random, settings.lane_gaps_per_10m, settings.lane_gap_m, length_m, CROP_BETWEEN_M)
    apart = (drawn[:, None, 0] > placed[:, 1] + CROP_BETWEEN_M) | (
        drawn[:, None, 1] < placed[:, 0] - CROP_BETWEEN_M
    )
    gaps = np.vstack([placed, drawn[apart.all(axis=1)]])
    return np.asarray(gaps[np.argsort(gaps[:, 0], kind="stable")])


def placed_gaps(field: FieldSettings, lane: int, row: int, length_m: float) -> Floats:
    """Gaps of the field file, shape (n, 2); one that reaches the field's start or end has no bound there.

    lane counts from 0, row as in the file, from 1 or ALL_ROWS.
    """
    named = [gap for gap in field.gaps.placed if (gap.lane - 1, gap.row) == (lane, row)]
    ends = np.array([(gap.start_m, gap.start_m + gap.length_m) for gap in named]).reshape(-1, 2)
    starts = np.where(ends[:, 0] <= 0, -np.inf, ends[:, 0])
    return np.stack([starts, np.where(ends[:, 1] >= length_m, np.inf, ends[:, 1])], axis=-1)


def draw_gaps(
    random: np.random.Generator,
    per_10m: float,
    length_m: tuple[float, float],
    row_length_m: float,
    between_m: float = PLANTS_BETWEEN_M,
) -> Floats:
    """Gaps (start, end) in metres along a row, shape (n, 2), in order, apart from each other."""
    count = random.poisson(per_10m * row_length_m / PER_M)
    lengths = random.uniform(*length_m, count)
    starts = random.uniform(ENDS_KEPT_M, max(row_length_m - ENDS_KEPT_M, ENDS_KEPT_M), count)
    kept: list[tuple[float, float]] = []
    for start, length in sorted(zip(starts.tolist(), lengths.tolist(), strict=True)):
        clear = not kept or start - kept[-1][1] >= between_m
        if clear and start + length <= row_length_m - ENDS_KEPT_M:
            kept.append((start, start + length))
    return np.array(kept, dtype=float).reshape(-1, 2)


def outside(way_m: Floats, gaps: Floats) -> NDArray[np.bool_]:
    """Which of the distances, shape (n,), lie in none of the gaps, shape (m, 2)."""
    within = (way_m[:, None] > gaps[:, 0]) & (way_m[:, None] < gaps[:, 1])
    return np.asarray(~within.any(axis=1))
