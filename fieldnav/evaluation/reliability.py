"""Whether a row of confidence 0.8 is right eight times in ten."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.evaluation.benchmark import Better, Figure
from fieldnav.messages import Floats

CASE = "reliability of confidence"
BINS = 10
"""Of equal width over 0 to 1."""


@dataclass(frozen=True, slots=True)
class JudgedRows:
    """Rows found: their confidence, shape (n,), and whether each is a true row, shape (n,)."""

    confidence: Floats
    right: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.right)

    @classmethod
    def joined(cls, parts: "Iterable[JudgedRows]") -> "JudgedRows":
        """The rows of several pictures."""
        each = list(parts)
        confidence = np.concatenate([np.empty(0), *(part.confidence for part in each)])
        right = np.concatenate([np.empty(0, np.bool_), *(part.right for part in each)])
        return cls(confidence, right)


@dataclass(frozen=True, slots=True)
class Bin:
    """The rows given a confidence from `low` to `high`: how many, how many of them right, the mean given."""

    low: float
    high: float
    count: int
    right: int
    confidence: float

    @property
    def share(self) -> float:
        return self.right / self.count

    @property
    def standard_error(self) -> float:
        """Of the share, as of a binomial draw; Laplace's estimate, so that 3 of 3 is not certain."""
        estimate = (self.right + 1) / (self.count + 2)
        return float(np.sqrt(estimate * (1 - estimate) / self.count))


def bins(rows: JudgedRows) -> list[Bin]:
    """The bins that hold any row, by rising confidence."""
    place, counts = _bin_of(rows), counts_by_bin(rows)
    return [_bin(int(number), rows, place == number) for number in np.flatnonzero(counts)]


def counts_by_bin(rows: JudgedRows) -> NDArray[np.int64]:
    """How many rows each bin holds, shape (BINS,)."""
    return np.bincount(_bin_of(rows), minlength=BINS)


def _bin_of(rows: JudgedRows) -> NDArray[np.int64]:
    return np.clip(np.floor(rows.confidence * BINS), 0, BINS - 1).astype(np.int64)


def _bin(number: int, rows: JudgedRows, inside: NDArray[np.bool_]) -> Bin:
    count, right = int(inside.sum()), int(rows.right[inside].sum())
    mean = float(rows.confidence[inside].mean())
    return Bin(number / BINS, (number + 1) / BINS, count, right, mean)


def calibration_error(rows: JudgedRows) -> float:
    """Mean difference between confidence and share right, by rows (expected calibration error); NaN of none.

    Naeini, Cooper, Hauskrecht, AAAI 2015.
    """
    if not len(rows):
        return float("nan")
    return sum(each.count * abs(each.share - each.confidence) for each in bins(rows)) / len(rows)


def reliability(rows: JudgedRows, photographs: str | None = None) -> list[Figure]:
    """The share right of each bin, its standard error as the deviation, and the calibration error.

    photographs: the set that all rows are of, None for those of every set.
    """
    case = CASE if photographs is None else f"{CASE}: {photographs}"
    shares = [
        Figure(
            case,
            f"share right of rows given {each.low:.1f} to {each.high:.1f}",
            each.share,
            each.standard_error,
        )
        for each in bins(rows)
    ]
    error = calibration_error(rows)
    return [*shares, Figure(case, "expected calibration error", error, better=Better.LOWER)]
