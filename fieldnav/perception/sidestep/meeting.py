"""Rows that come into view: the sliding window of III-A.2 over what no known row explains."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.perception.sidestep.passing_rows import Crossing, PassingRow, only, with_row
from fieldnav.perception.sidestep.row_words import words
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

WINDOW = 1.0
"""Width of the sliding window over the canopy's width."""
APART = 0.35
"""Of the row spacing: nearer than this to a row there is no other."""
ONE = 0.35
"""Of the row spacing: rows nearer to each other than this are one."""
ROW_MASS = 0.45
"""Whole plants in the window that may be a row; most weeds have a tenth of one."""
LEAST_OF_USUAL = 0.2
"""Of what a row usually shows; rows that begin 0.3 m later than their neighbours show about half."""
MOST_ROWS = 24
"""Weeds everywhere must not make the filter slow; the lanes under way have half as many rows."""
FORGOTTEN = -2.0
"""A row whose plants say this against it was none."""


def met(
    crossing: Crossing,
    across: Floats,
    weight: Floats,
    row: NDArray[np.int64],
    crop: CropProfile,
    camera: Pinhole,
) -> Crossing:
    """With the row, if any, that the plants of no row show beyond the old lane and within the view."""
    if len(crossing.rows) >= MOST_ROWS:
        return crossing
    edge_m = crossing.rows[crossing.outermost_old].across_m + APART * crop.rows.spacing_m
    away = np.abs(across[:, None] - crossing.places_m[None, :]).min(axis=1)
    free = (row < 0) & (across > edge_m) & (away > APART * crop.rows.spacing_m)
    place = _heaviest(across[free], weight[free], crossing.usual_mass, crossing.viewed_m, crop)
    return crossing if place is None else with_row(crossing, PassingRow(place), crop, camera)


def _heaviest(
    places: Floats, mass: Floats, usual_mass: float, limit_m: float, crop: CropProfile
) -> float | None:
    """Where the sliding window holds most, if it holds enough for a row."""
    if not len(places):
        return None
    inside = np.abs(places[None, :] - places[:, None]) <= WINDOW * crop.plants.canopy_width_m / 2
    heavy = inside @ mass
    best = int(heavy.argmax())
    if heavy[best] < max(ROW_MASS, LEAST_OF_USUAL * usual_mass):
        return None
    place = float(np.average(places[inside[best]], weights=mass[inside[best]]))
    return place if place <= limit_m else None


def forgotten(crossing: Crossing, crop: CropProfile) -> Crossing:
    """Without rows that were none, and without the lesser of two that have come together."""
    kept = [index for index, row in enumerate(crossing.rows) if row.of_old_lane or row.plants > FORGOTTEN]
    for index in sorted(kept, key=lambda each: words(crossing, each, crop).total):
        near = [
            other
            for other in kept
            if other != index
            and abs(crossing.rows[other].across_m - crossing.rows[index].across_m) < ONE * crop.rows.spacing_m
        ]
        if near and not crossing.rows[index].of_old_lane:
            kept.remove(index)
    return crossing if len(kept) == len(crossing.rows) else only(crossing, kept)


def all_known(crossing: Crossing) -> Crossing:
    """Only the rows of the lane that was left: what was met since is looked at anew."""
    kept = [index for index, row in enumerate(crossing.rows) if row.of_old_lane]
    return replace(only(crossing, kept), viewed_m=-float("inf"))
