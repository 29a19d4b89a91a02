"""Stretches of a row, or of a whole lane, where nothing came up."""

import numpy as np

from fieldnav.messages import Floats

ENDS_KEPT_M = 1.0  # of a row at both its ends, so that the row's end is where its last plant stands
PLANTS_BETWEEN_M = 0.5  # at least, between two gaps: two gaps never join to one longer than asked for
PER_M = 10.0  # gaps are counted per this length


def draw_gaps(
    random: np.random.Generator, per_10m: float, length_m: tuple[float, float], row_length_m: float
) -> Floats:
    """Gaps (start, end) in metres along a row, shape (n, 2), in order, apart from each other."""
    count = random.poisson(per_10m * row_length_m / PER_M)
    lengths = random.uniform(*length_m, count)
    starts = random.uniform(ENDS_KEPT_M, max(row_length_m - ENDS_KEPT_M, ENDS_KEPT_M), count)
    kept: list[tuple[float, float]] = []
    for start, length in sorted(zip(starts.tolist(), lengths.tolist(), strict=True)):
        clear = not kept or start - kept[-1][1] >= PLANTS_BETWEEN_M
        if clear and start + length <= row_length_m - ENDS_KEPT_M:
            kept.append((start, start + length))
    return np.array(kept, dtype=float).reshape(-1, 2)


def outside(s: Floats, gaps: Floats) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Which of the distances `s`, shape (n,), lie in none of the gaps, shape (m, 2)."""
    within = (s[:, None] > gaps[:, 0]) & (s[:, None] < gaps[:, 1])
    return np.asarray(~within.any(axis=1))
