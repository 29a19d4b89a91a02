"""Whether the lane has ended or only has a gap: a decision over distance, by what both cameras saw of it."""

from dataclasses import dataclass
from math import exp, log, pi, sqrt

import numpy as np

from fieldnav.estimation.crop_along import BIN_M, CropAlong
from fieldnav.messages import Floats
from fieldnav.settings.crop import CropProfile

NEIGHBOURHOOD_M = 0.4  # to either side, at least; two plants' distances where plants stand wider
LEAST_SHARE = 0.13  # of what a lane usually holds: less is a weed or two in line with a row
PLANT_BINS, LEAST_PLANT = 2, 0.25  # bins to either side that one plant's sightings fall into; less is a weed
LEAST_BIN = 0.05  # of a whole plant: the far edge of where it was seen
LEAST_OF_PROFILE = 0.3  # a thin stand holds at least this share of what the profile lets expect
RARE = 0.01  # share of gaps that are longer than the profile's longest
GAPS_PER_M = 0.04  # of all rows at once: one in 25 m
ENDS_PER_M = 0.02  # where nothing is known of the lane's length: once in 50 m
LENGTH_SD_M, LENGTH_SD_SHARE = 0.5, 0.02  # ends are ragged, and wheels slip
ODD_LANES = 0.1  # share of lanes that are not as long as those before: headlands run askew, corners are cut


@dataclass(frozen=True, slots=True)
class LaneEndView:
    """What is known of the end of a lane.

    crop_until_m: s of the last crop; seen_until_m: s up to which the leading camera has looked;
    probability: that the lane ends at the last crop.
    """

    crop_until_m: float
    seen_until_m: float
    probability: float

    @property
    def empty_m(self) -> float:
        """How far beyond the last crop there is none."""
        return max(0.0, self.seen_until_m - self.crop_until_m)


class LaneEnd:
    """Both cameras' strips of one lane; s counts from where the lane was entered."""

    def __init__(
        self, crop: CropProfile, begin_m: float, expected_m: float | None, first_m: float | None = None
    ) -> None:
        """begin_m: the least s that is seen; expected_m: length of the lanes before, None on the first;
        first_m: s of the lane's first crop, where it is known already.
        """
        self._crop, self._expected_m = crop, expected_m
        self._leading, self._trailing = CropAlong(begin_m), CropAlong(begin_m)
        plants = crop.plants
        # Plants that touch are seen as one: regions are not told apart further than a canopy's width.
        self._full_per_m = crop.rows.per_lane / max(plants.spacing_m, plants.canopy_width_m)
        self.first_m = first_m
        self._until_m: float | None = None
        self._seen_m = begin_m

    def lead(self, s_m: Floats, weight: Floats, view_m: tuple[float, float]) -> None:
        """Take in a frame of the leading camera; see `CropAlong.add`."""
        self._leading.add(s_m, weight, view_m)
        self._seen_m = max(self._seen_m, view_m[1])

    def trail(self, s_m: Floats, weight: Floats, view_m: tuple[float, float]) -> None:
        """Take in a frame of the trailing camera."""
        self._trailing.add(s_m, weight, view_m)

    def look_again(self) -> None:
        """Rows run elsewhere than they were looked for: what was seen past the last crop does not count."""
        if self._until_m is not None:
            self._leading.forget(self._until_m)
            self._seen_m = self._until_m

    def judge(self) -> LaneEndView:
        """What the strips say: the last crop is the furthest that either camera has seen."""
        led, trailed = self._last_crop_m(self._leading), self._last_crop_m(self._trailing)
        known = [each for each in (led, trailed) if each is not None]
        if known:
            self._until_m = max(known)
        until = self._seen_m if self._until_m is None else self._until_m  # strips forget, in a long gap
        if self.first_m is None:
            self.first_m = until
        return LaneEndView(until, self._seen_m, self._probability(until))

    def length_m(self) -> float:
        """From where crop was first judged to the last."""
        return self.judge().crop_until_m - (self.first_m or 0.0)

    def _last_crop_m(self, along: CropAlong) -> float | None:
        """s of the last crop: a whole plant or what is left of one, with a stand about it."""
        s, held, _ = along.strip()
        reach = round(max(NEIGHBOURHOOD_M, 2 * self._crop.plants.spacing_m) / BIN_M)
        about, plant = _within(held.clip(0), reach), _within(held, PLANT_BINS)
        full = self._full_per_m * (2 * reach + 1) * BIN_M
        standing = about[about > LEAST_SHARE * full]
        usual = max(LEAST_OF_PROFILE * full, float(np.median(standing)) if len(standing) else 0.0)
        crop = (about >= LEAST_SHARE * usual) & (plant >= LEAST_PLANT) & (held >= LEAST_BIN)
        return float(s[crop][-1]) if crop.any() else None

    def _probability(self, until_m: float) -> float:
        """Bayes: the lane ends here, against a gap at least as long as what was seen empty, or none at all.

        What is longer than a length becomes rare with its square: fields have gaps up to some length and
        hardly any of twice that, and a drill leaves no two plants thrice as far apart as the others.
        """
        empty_m = max(0.0, self._seen_m - until_m)
        longest_m = max(self._crop.row_end.longest_gap_m, BIN_M)
        gap = GAPS_PER_M * exp(log(RARE) * (empty_m / longest_m) ** 2)
        thin_per_m = LEAST_OF_PROFILE * self._full_per_m
        goes_on = thin_per_m * exp(-((thin_per_m * empty_m) ** 2))
        end = self._ends_per_m(until_m)
        return end / (end + gap + goes_on)

    def _ends_per_m(self, until_m: float) -> float:
        if self._expected_m is None:
            return ENDS_PER_M
        spread = LENGTH_SD_M + LENGTH_SD_SHARE * self._expected_m
        off = (until_m - (self.first_m or 0.0) - self._expected_m) / spread
        like_before = exp(-off * off / 2) / (spread * sqrt(2 * pi))
        return (1 - ODD_LANES) * like_before + ODD_LANES * ENDS_PER_M


def _within(held: Floats, bins: int) -> Floats:
    """The sum over so many bins to either side, shape (bins,)."""
    return np.convolve(held, np.ones(2 * bins + 1), mode="same")
