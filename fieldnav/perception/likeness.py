"""How like a row is to the one known: the share of its features that moved over the ground together.

A robot that steps sideways moves all of a row by one common shift and turns none of it; features of another
row that happen to look alike lie anywhere. The paper's measure, a mean distance of descriptors (III-C), knows
nothing of where they lie; it is given beside. Matches agree by voting for a common pose (Lowe, International
Journal of Computer Vision 60, 2004, section 7.3).
"""

from dataclasses import dataclass
from math import erf, sqrt

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.perception.recognition import Descriptors, distance
from fieldnav.settings.crop import CropProfile

Indices = NDArray[np.int64]

HALF_TURN_DEG, FULL_TURN_DEG = 180.0, 360.0

MOST_TURN_DEG = 20.0  # of a feature; a row leans by up to ten degrees more where the view has moved on
MOST_GROWTH = 1.5  # of a feature, either way
MOST_ALONG_M = 0.15  # the robot steps sideways: along the rows it only drifts, and pitches
MOST_ASIDE_M = 0.08  # against the row's line: how far the lines of the two frames may be off
ASIDE_OF_SPACING = 0.4  # the same over the row spacing: no row is known by its neighbour's plants
TOGETHER_M = (0.035, 0.06)  # along and across: ground, stems and the tips of leaves shift by unlike amounts


@dataclass(frozen=True, slots=True)
class Likeness:
    """One row seen twice, or two rows.

    together: features that moved together, of `compared`, the number in the poorer of the two sets;
    shift_m: how they moved over the ground in the camera's view, ahead and left; None where none did;
    distance: the paper's measure; threshold: the share below which a row is new.
    """

    together: int
    compared: int
    shift_m: tuple[float, float] | None
    distance: float
    threshold: float

    @property
    def share(self) -> float:
        return self.together / self.compared

    @property
    def is_new(self) -> bool:
        return self.share < self.threshold

    @property
    def sure(self) -> float:
        """Probability, 0.5 to 1, that more features would leave the share on its side of the threshold."""
        error = sqrt(self.threshold * (1 - self.threshold) / self.compared)
        return (1 + erf(abs(self.share - self.threshold) / error / sqrt(2))) / 2


def likeness(reference: Descriptors, candidate: Descriptors, crop: CropProfile) -> Likeness | None:
    """How like the candidate is to the reference; None when either has too few features to tell."""
    away = distance(reference, candidate, crop.recognition.match_ratio)
    if away is None:
        return None
    old, new = _possible(reference, candidate, *_both_ways(reference, candidate), crop)
    moved_m = candidate.ground_m[new] - reference.ground_m[old]
    aside_m = candidate.beside_m[new] - reference.beside_m[old]
    group = _largest_group(np.stack([moved_m[:, 0], aside_m], axis=-1))
    together, compared = int(group.sum()), min(len(reference), len(candidate))
    shift_m = tuple(moved_m[group].mean(axis=0).tolist()) if together else None
    return Likeness(together, compared, shift_m, away, crop.recognition.new_row_share)


def _both_ways(reference: Descriptors, candidate: Descriptors) -> tuple[Indices, Indices]:
    """Pairs of features of which each is the other's nearest: their indices in either set, shape (m,)."""
    matches = cv2.BFMatcher(cv2.NORM_L2, crossCheck=True).match(candidate.vectors, reference.vectors)
    pairs = np.array([(match.trainIdx, match.queryIdx) for match in matches], np.int64).reshape(-1, 2)
    return pairs[:, 0], pairs[:, 1]


def _possible(
    reference: Descriptors, candidate: Descriptors, old: Indices, new: Indices, crop: CropProfile
) -> tuple[Indices, Indices]:
    """Those pairs that can be one and the same thing, seen again after a step sideways."""
    turned_deg = (candidate.angle_deg[new] - reference.angle_deg[old] + HALF_TURN_DEG) % FULL_TURN_DEG
    grown = np.abs(np.log(candidate.size_px[new] / reference.size_px[old]))
    along_m = np.abs(candidate.ground_m[new, 0] - reference.ground_m[old, 0])
    aside_m = np.abs(candidate.beside_m[new] - reference.beside_m[old])
    possible = (
        (np.abs(turned_deg - HALF_TURN_DEG) <= MOST_TURN_DEG)
        & (grown <= np.log(MOST_GROWTH))
        & (along_m <= MOST_ALONG_M)
        & (aside_m <= min(MOST_ASIDE_M, ASIDE_OF_SPACING * crop.rows.spacing_m))
    )
    return old[possible], new[possible]


def _largest_group(shift_m: Floats) -> NDArray[np.bool_]:
    """Which shifts, shape (m, 2), belong to the largest group about any one of them; shape (m,)."""
    if not len(shift_m):
        return np.zeros(0, bool)
    near: NDArray[np.bool_] = np.all(np.abs(shift_m[:, None] - shift_m[None, :]) <= TOGETHER_M, axis=-1)
    return np.asarray(near[near.sum(axis=1).argmax()])
