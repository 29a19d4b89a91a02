"""Rows fitted to the plants near them, and kept to their places between each other (paper III-A.3)."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats, RowLine
from fieldnav.perception.ground_plants import GroundPlants
from fieldnav.perception.ground_rows import GroundRows, Indices, fit, members
from fieldnav.perception.lane import comb_m
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

OFF_PLACE = 0.22  # of the row spacing: a row further from its place in the comb has drifted onto weeds
RETURN = 0.1  # share of its way back to its place in the comb that a row goes each frame
WIDER = 1.8  # parallelogram against the canopy's while the lane's own movement is not known yet
WIDEST = 0.45  # of the row spacing: half a parallelogram's width is never more, so that no plant is in two
SCATTER = 0.15  # of the canopy's width: standard deviation of a plant's centre from its row
SMALLEST_SCATTER_M = 0.02
STRAY = 0.3  # share of the plants that is no crop


@dataclass(frozen=True, slots=True)
class Followed:
    """A comb after a frame; seen: which rows the frame showed; counts: plants in each. Shape (rows,)."""

    comb: GroundRows
    seen: NDArray[np.bool_]
    counts: Indices

    @property
    def confidence(self) -> Floats:
        """The probability that not all plants of a row are weeds; 0 where it was not seen."""
        return np.asarray(self.seen * (1 - STRAY**self.counts))


def scatter_m(crop: CropProfile) -> float:
    """Standard deviation of a plant's centre from its row."""
    return max(SCATTER * crop.plants.canopy_width_m, SMALLEST_SCATTER_M)


def widest_m(crop: CropProfile) -> float:
    """The most that half a parallelogram's width may be."""
    return WIDEST * crop.rows.spacing_m


def comb_of(rows: tuple[RowLine, ...], crop: CropProfile, plane: Pinhole) -> GroundRows:
    """The comb on the ground that a lane's row lines make."""
    about_m = sum(plane.view_m) / 2
    offset, slope = np.array([plane.row_on_ground(row) for row in rows]).T
    place = offset + slope * about_m
    middle = float(np.mean(place - comb_m(crop)))
    return GroundRows(middle, float(np.mean(slope)), place - middle, slope - np.mean(slope), about_m)


def follow(comb: GroundRows, plants: GroundPlants, crop: CropProfile) -> Followed:
    """Fit a comb to the plants near its rows: first in wide parallelograms, then in the canopy's."""
    for wider in (WIDER, 1.0):
        row = members(comb, plants, widest_m(crop), wider)
        comb = fit(comb, plants, row, scatter_m(crop))
    counts = np.bincount(row[row >= 0], minlength=len(comb.place_m))
    return _kept_in_place(comb, counts, crop)


def _kept_in_place(comb: GroundRows, counts: Indices, crop: CropProfile) -> Followed:
    """Draw the rows towards their places in the comb; one that has left its place has not been seen."""
    place = comb_m(crop)
    off = comb.place_m - place
    middle = float(np.median(off))
    in_place = np.abs(off - middle) <= OFF_PLACE * crop.rows.spacing_m
    kept = place + middle + np.where(in_place, (off - middle) * (1 - RETURN), 0.0)
    moved = replace(comb, place_m=kept, turn=comb.turn * (1 - RETURN))
    return Followed(moved, in_place & (counts >= crop.tracking.fewest_centres), counts)
