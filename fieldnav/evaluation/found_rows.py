"""The rows that a finder reports in one picture, and which true row each of them is."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from fieldnav.messages import Floats, Image, RowLine
from fieldnav.settings.crop import CropProfile, RowFinder

Indices = NDArray[np.int64]

LEAST_CONFIDENCE = 0.5  # of a row that counts as reported; at less it is more likely wrong than right
UNMATCHED = -1


@dataclass(frozen=True, slots=True)
class FoundRows:
    """The rows found in a picture, left to right.

    paths_px: shape (rows, points, 2), x and y along each row's curve, from the top edge to the bottom one.
    """

    lines: tuple[RowLine, ...]
    paths_px: Floats

    @property
    def confidence(self) -> Floats:
        """Shape (rows,), within 0 and 1."""
        return np.array([line.confidence for line in self.lines], dtype=np.float64)

    def sure(self) -> "FoundRows":
        """Only the rows that count as reported."""
        keep = np.flatnonzero(self.confidence >= LEAST_CONFIDENCE)
        return FoundRows(tuple(self.lines[index] for index in keep), self.paths_px[keep])


Finder = Callable[[Image, CropProfile | None], FoundRows]
"""Finds the rows of a picture whose camera is not known; None for a crop that is not known either."""


def with_method(crop: CropProfile, method: RowFinder) -> CropProfile:
    """The same profile, finding rows by a method."""
    return crop.model_copy(update={"finding": crop.finding.model_copy(update={"method": method})})


def match(distance: Floats, limit: float) -> Indices:
    """Which true row each found row is, one to one, at the smallest distances; shape (found,).

    distance: shape (found, true); a pair matches below `limit`. UNMATCHED for a row that is none of them.
    """
    found, true = linear_sum_assignment(np.minimum(distance, limit))
    near = distance[found, true] < limit
    matched = np.full(len(distance), UNMATCHED, dtype=np.int64)
    matched[found[near]] = true[near]
    return matched
