"""How likely a lane is at a place: as the drill has it, by the rows seen there, by the places seen empty."""

from dataclasses import dataclass
from math import log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.perception.sidestep.passing_rows import Crossing
from fieldnav.perception.sidestep.row_words import words
from fieldnav.settings.crop import CropProfile

SOWN = 0.9
"""Probability that a row of a lane is there to be seen."""
STRAY_PER_M = 0.15
"""Lines of weeds that pass for rows, per metre; our choice."""
UNEVEN = 0.08
"""Of the row spacing: standard deviation of a row's distance from its place in the lane."""
WANDER_M = 0.02
"""The same from rows that are not quite straight, and scattered plants."""
UNEXPECTED = 1e-4
"""Density per metre of a lane anywhere, against the drill's: it may have missed its mark."""
WIDEST_GAP_M, WIDEST_ROBOT_M = 1.2, 1.8
"""Where the distance is not known: between lanes is room for wheels; lanes are as wide as a robot."""
OFF_EXPECTED = 3.0
"""Standard deviations from where a lane was expected, beyond which it is another lane."""
SIDE_BY_SIDE = 0.15
"""Of the row spacing: with a gap so near to it rows go on evenly from lane to lane."""


@dataclass(frozen=True, slots=True)
class Expected:
    """What is known beforehand: the distance from lane to lane, None if not, how surely, and the bound."""

    pitch_m: float | None
    spread_m: float
    longest_m: float

    def off_m(self, pitch_m: float, crop: CropProfile) -> tuple[float, float]:
        """How far off a lane at this distance stands, and at most may; further off is another, or none."""
        if self.pitch_m is None:
            return pitch_m, widest_pitch_m(crop)
        return abs(pitch_m - self.pitch_m), OFF_EXPECTED * self.spread_m


def widest_pitch_m(crop: CropProfile) -> float:
    """The furthest that the next lane is looked for where nothing is known of the drill."""
    return max(WIDEST_ROBOT_M, (crop.rows.per_lane - 1) * crop.rows.spacing_m + WIDEST_GAP_M)


def goes_on(pitch_m: Floats | float, crop: CropProfile) -> NDArray[np.bool_]:
    """Whether the rows of lanes at this distance go on evenly from one to the next."""
    gap_m = np.asarray(pitch_m) - (crop.rows.per_lane - 1) * crop.rows.spacing_m
    return np.asarray(np.abs(gap_m - crop.rows.spacing_m) < SIDE_BY_SIDE * crop.rows.spacing_m)


def prior(pitch_m: Floats, expected: Expected, crop: CropProfile) -> Floats:
    """Logarithm of the density of lanes at each distance from the old one."""
    if expected.pitch_m is None:
        return np.where(pitch_m <= widest_pitch_m(crop), 0.0, log(UNEXPECTED))
    off = (pitch_m - expected.pitch_m) / expected.spread_m
    return np.asarray(np.log(np.exp(-(off**2) / 2) / (expected.spread_m * sqrt(2 * pi)) + UNEXPECTED))


def evidence(crossing: Crossing, old_m: float, pitch_m: Floats, comb: Floats, crop: CropProfile) -> Floats:
    """Logarithm of how much likelier a lane at each distance makes what was seen, shape of `pitch_m`."""
    middle_m = old_m + pitch_m
    place = middle_m[:, None] + comb
    by_row = _alike(crossing, place, crop)
    score = np.where(place <= crossing.viewed_m, np.log(1 - SOWN + SOWN * by_row), np.log1p(by_row))
    total = score.sum(axis=1)
    if len(comb) > 1:  # a single row says nothing of where the next one stands
        beside = (len(comb) + 1) / 2 * crop.rows.spacing_m
        for side in (-beside, beside):
            row = _alike(crossing, middle_m[:, None] + side, crop)[:, 0]
            total -= np.where(goes_on(pitch_m, crop), 0.0, np.log1p(SOWN * row))
    return np.asarray(total)


def _alike(crossing: Crossing, place: Floats, crop: CropProfile) -> Floats:
    """How much likelier the row near a place is a lane's there than a stray one, shape of `place`."""
    ratio = np.zeros_like(place)
    for index in crossing.new:
        spread = _spread_m(crossing, index, crop)
        off = (place - crossing.rows[index].across_m) / spread
        density = np.exp(-(off**2) / 2) / (spread * sqrt(2 * pi))
        ratio = np.maximum(ratio, words(crossing, index, crop).probability * density / STRAY_PER_M)
    return np.asarray(ratio)


def _spread_m(crossing: Crossing, index: int, crop: CropProfile) -> float:
    own = max(float(crossing.covariance[index, index]), 0.0)
    return sqrt(WANDER_M**2 + (UNEVEN * crop.rows.spacing_m) ** 2 + min(own, WANDER_M**2))
