"""Which seeds of a lane come up: germination, gaps, and crop that is never farther than the gaps say.

Chance alone would now and then empty all rows at once, or carry a gap across the lane far on: then seeds are
kept, so that the field file's bounds are the truth.
"""

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.settings.field import FieldSettings
from fieldnav.simulation.gaps import draw_gaps, lane_gaps, outside, placed_gaps
from fieldnav.simulation.streams import Stream, random_stream

Flags = NDArray[np.bool_]

PIECE_M = 0.3  # of a lane: in each that is in no gap across the lane, some row has a plant
PIECE_PLANTS = 1.5  # the same at least, in distances between two plants
FEWEST_ROWS = 2  # of a lane of one row, each gap in a row is one across the lane


def emerging(
    field: FieldSettings, lane: int, seeds: dict[int, Floats], spacing_m: float, length_m: float
) -> dict[int, Flags]:
    """Which seeds of each sown row come up, shape (n,) each.

    seeds: by row, from 0, metres along the lane, in order; length_m: of the lane.
    """
    across = lane_gaps(field, lane, length_m)
    allowed = {
        row: outside(way, across) & outside(way, placed_gaps(field, lane, row + 1, length_m))
        for row, way in seeds.items()
    }
    up = {row: allowed[row] & _by_chance(field, lane, row, way, length_m) for row, way in seeds.items()}
    if not seeds:
        return up
    rows = np.repeat(list(seeds), [way.size for way in seeds.values()])
    ways, may, does = (np.concatenate(list(each.values())) for each in (seeds, allowed, up))
    _keep_beside(across, ways, may, does)
    if len(seeds) >= FEWEST_ROWS:
        _keep_in_pieces(max(PIECE_M, PIECE_PLANTS * spacing_m), across, ways, rows, may, does)
    return {row: does[rows == row] for row in seeds}


def _by_chance(field: FieldSettings, lane: int, row: int, way_m: Floats, length_m: float) -> Flags:
    """Germination and the row's own gaps. The first and the last seed always come up: they are its ends."""
    random = random_stream(field.seed, Stream.ROW_GAPS, lane, row)
    row_gaps = draw_gaps(random, field.gaps.row_gaps_per_10m, field.gaps.row_gap_m, length_m)
    germination = random_stream(field.seed, Stream.GERMINATION, lane, row)
    up = germination.random(way_m.size) < field.gaps.germination
    up[[0, -1]] = True
    return up & outside(way_m, row_gaps)


def _keep_beside(across: Floats, ways: Floats, may: Flags, does: Flags) -> None:
    """Keep the seed next to each end of the gaps across the lane, in place."""
    for start, end in across:
        for beyond in (may & (ways <= start), may & (ways >= end)):
            if beyond.any():
                away = np.where(beyond, np.minimum(np.abs(ways - start), np.abs(ways - end)), np.inf)
                does[int(away.argmin())] = True


def _keep_in_pieces(
    piece_m: float, across: Floats, ways: Floats, rows: NDArray[np.intp], may: Flags, does: Flags
) -> None:
    """In each piece of the lane where no row has a plant, keep the seeds of the row whose first is first."""
    # Pieces are told apart by their gap too: a gap's two sides are never one piece.
    piece = np.floor(ways / piece_m).astype(int) * (len(across) + 1) + np.searchsorted(across[:, 0], ways)
    for empty in np.setdiff1d(piece[may], piece[does]):
        own = may & (piece == empty)
        first = np.flatnonzero(own)[ways[own].argmin()]
        does |= own & (rows == rows[first])
