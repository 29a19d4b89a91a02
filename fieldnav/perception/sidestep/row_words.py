"""What speaks for a row that is there and is new: its plants, the wheels, its features (paper III-C).

Each word is a natural logarithm of odds and is bounded, so that each can be wrong for a while. They add up.
"""

from dataclasses import dataclass
from math import exp, log, pi, sqrt

from fieldnav.perception.likeness import Likeness
from fieldnav.perception.sidestep.passing_rows import Crossing
from fieldnav.settings.crop import CropProfile

DOUBT = 3.0
"""What must be outweighed before a row is as likely as none."""
MOST_BY_PLANTS = 5.0
LEAST_BY_PLANTS = -4.0
PLANTS_FOR = 2.0
"""Word of a frame that shows a whole usual row more than LEAST_SHOWN, before it is bounded."""
LEAST_SHOWN = 0.15
"""Of what a row usually shows; weeds in line show less, rows that begin 0.5 m later about 0.3."""
MOST_IN_FRAME = 0.6
LEAST_IN_FRAME = -0.25
MOST_BY_WHEELS = 3.0
JUDGED_M = 0.05
"""Standard deviation of the distance between two rows that the filter does not know of: rows wander."""
MOST_BY_FEATURES = 1.5
SMALLEST = 1e-9
FEATURES_SHARE = 0.4
"""Share that one comparison has in the word of the features."""
CERTAIN = 0.9
"""Probability from which on a row counts."""


@dataclass(frozen=True, slots=True)
class Words:
    """What each says for a row that is new, and their sum; natural logarithms of odds."""

    plants: float
    wheels: float
    features: float

    @property
    def total(self) -> float:
        return self.plants + self.wheels + self.features - DOUBT

    @property
    def probability(self) -> float:
        return 1 / (1 + exp(-self.total))

    @property
    def certain(self) -> bool:
        return self.probability >= CERTAIN


def words(crossing: Crossing, index: int, crop: CropProfile) -> Words:
    """What speaks for one of the rows."""
    row = crossing.rows[index]
    return Words(row.plants, _by_wheels(crossing, index, crop), row.features)


def by_plants(before: float, shown: float, frames: float) -> float:
    """The word of the plants after a frame that shows so much of a row, 1 being a usual one.

    frames: how much of a frame's motion lies between this frame and the last; a second look at the same
    plants from the same place is hardly another one.
    """
    word = frames * max(LEAST_IN_FRAME, min(MOST_IN_FRAME, PLANTS_FOR * (shown - LEAST_SHOWN)))
    return max(LEAST_BY_PLANTS, min(MOST_BY_PLANTS, before + word))


def by_features(before: float, like: Likeness) -> float:
    """The word of the features after a comparison with the known row."""
    odds = log(like.sure / max(1 - like.sure, SMALLEST))
    word = min(MOST_BY_FEATURES, odds) * (1 if like.is_new else -1)
    return before + FEATURES_SHARE * (word - before)


def _by_wheels(crossing: Crossing, index: int, crop: CropProfile) -> float:
    """How much likelier another row is here than the known row nearest to it, taken for another."""
    row, old = crossing.rows[index], crossing.outermost_old
    apart_m = row.across_m - crossing.rows[old].across_m
    spread = crossing.covariance
    variance = float(spread[index, index] + spread[old, old] - 2 * spread[index, old])
    variance = max(variance, 0.0) + JUDGED_M**2
    odds = apart_m**2 / (2 * variance) + log(sqrt(2 * pi * variance) / crop.rows.spacing_m)
    return max(-MOST_BY_WHEELS, min(MOST_BY_WHEELS, odds))
