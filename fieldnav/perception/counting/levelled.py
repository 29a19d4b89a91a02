"""A picture's vegetation with the perspective taken out: rows upright, so that moving sideways is one shift.

Positions are in picture widths at mid-height, from the middle column to the right.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import COLUMNS, LEVEL, Bands
from fieldnav.perception.comb.finder import convergence_of
from fieldnav.perception.comb.row_comb import RowComb, growth

STEP = 1 / COLUMNS  # between the places of a levelled picture, as fine as the bands are
REACH = 0.65  # to either side: what the upper edge of a steep view still shows
PLACES: Floats = np.asarray(np.arange(-round(REACH / STEP), round(REACH / STEP) + 1) * STEP, float)
"""Where the columns of a levelled picture lie, shape (n,)."""
FURTHEST = 0.5  # of the ground's scale from that at mid-height; bands beyond show it too small or too large

Levels = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Perspective:
    """How rows run together and how far apart they are at mid-height, in widths; see `row_comb.straight`."""

    convergence: float
    vanishing: float
    spacing: float


@dataclass(frozen=True, slots=True)
class Levelled:
    """strength: shape (bands, n), 0 to 1, at PLACES; seen: the same, 1 where the picture has the place."""

    strength: Levels
    seen: Levels


def perspective_of(comb: RowComb) -> Perspective:
    """The perspective that a comb of rows was found in."""
    convergence = convergence_of(comb)
    usable = comb.usable
    slope, middle = np.polyfit(LEVEL[usable], comb.middle[usable], 1)
    spacing = float(np.interp(0.0, LEVEL[usable], comb.spacing[usable]))
    return Perspective(convergence, float(middle - slope / convergence) if convergence else 0.0, spacing)


def level(bands: Bands, perspective: Perspective) -> Levelled:
    """The vegetation of a picture as it would be without perspective."""
    grown = growth(perspective.convergence)[:, None]
    strength, inside = bands.sample(PLACES * grown + perspective.vanishing * (1 - grown))
    seen = np.asarray(inside & (np.abs(grown - 1) <= FURTHEST), np.float32)
    return Levelled(np.asarray(strength * seen, np.float32), seen)
