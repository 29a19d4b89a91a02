"""Where rows that pass sideways are: plants given to rows, rows carried along, rows come into view."""

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.settings.crop import CropProfile

SAME_ROW = 0.4
"""A line belongs to a known row within this share of the row spacing; a frame moves the rows by 1 cm."""
MEMBER = 0.6
"""A plant belongs to a row within this share of the canopy's width."""
WINDOW = 1.0
"""Width of the sliding window over the canopy's width."""
ROW_MASS = 0.45
"""Whole plants in the window that make a row; most weeds have a tenth of one."""
LEAST_OF_USUAL = 0.3
"""Of what a row usually shows; rows that begin 0.3 m later than their neighbours show about half."""
SMALLEST_MASS = 1e-6


def row_of(across: Floats, places: Floats, crop: CropProfile) -> NDArray[np.int64]:
    """The row that each plant belongs to, -1 for none; shape (n,)."""
    away = np.abs(across[:, None] - places[None, :])
    within = min(SAME_ROW * crop.rows.spacing_m, MEMBER * crop.plants.canopy_width_m)
    nearest = away.argmin(axis=1)
    return np.where(away.min(axis=1, initial=np.inf) <= within, nearest, -1)


def carried_along(places: Floats, across: Floats, weight: Floats, row: NDArray[np.int64]) -> Floats:
    """Rows at the weighted mean of their plants; those without any go along with the others."""
    count = len(places)
    inside = row >= 0
    mass = np.bincount(row[inside], weight[inside], count)
    mean = np.bincount(row[inside], (weight * across)[inside], count) / np.maximum(mass, SMALLEST_MASS)
    seen = mass > SMALLEST_MASS
    shift = np.where(seen, mean - places, 0.0)
    common = float(np.average(shift[seen], weights=mass[seen])) if seen.any() else 0.0
    return places + np.where(seen, shift, common)


def lean_of(
    ahead: Floats, across: Floats, weight: Floats, row: NDArray[np.int64], count: int
) -> tuple[float, float]:
    """Slope that the plants still have along their rows, and the spread in m2 that it rests on.

    The pooled weighted regression of all rows, each about its own middle.
    """
    inside = row >= 0
    row, weight = row[inside], weight[inside]
    mass = np.maximum(np.bincount(row, weight, count), SMALLEST_MASS)
    x = ahead[inside] - (np.bincount(row, weight * ahead[inside], count) / mass)[row]
    y = across[inside] - (np.bincount(row, weight * across[inside], count) / mass)[row]
    spread = float((weight * x * x).sum())
    return float((weight * x * y).sum()) / max(spread, SMALLEST_MASS), spread


def row_beyond(
    across: Floats, weight: Floats, least_m: float, usual_mass: float, crop: CropProfile
) -> float | None:
    """The nearest row beyond a place: the sliding window of III-A.2, the rows' heading being known.

    usual_mass: whole plants that a row shows in this view; weeds in line show less.
    """
    beyond = across > least_m
    places, mass = across[beyond], weight[beyond]
    if not len(places):
        return None
    half = WINDOW * crop.plants.canopy_width_m / 2
    inside = np.abs(places[None, :] - places[:, None]) <= half
    heavy = inside @ mass
    enough = heavy >= max(ROW_MASS, LEAST_OF_USUAL * usual_mass)
    if not enough.any():
        return None
    first = places[enough].min()
    near = enough & (places <= first + 2 * half)
    window = inside[near][int(heavy[near].argmax())]
    return float(np.average(places[window], weights=mass[window]))
