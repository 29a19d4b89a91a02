"""How the rows of a candidate stand out of what a witness shows: what is on them, and between them."""

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.perception.comb.candidates import Candidate

Witness = NDArray[np.float32]
"""What a witness shows of a picture, 0 to 1, shape (h, w) of any size."""

HEIGHTS: Floats = np.linspace(0.36, 0.97, 24)
"""Of the picture, from the upper edge: where rows are looked at. What lies above is far away."""
STRETCH = 4  # heights
ACROSS: Floats = np.linspace(-0.5, 0.5, 21)
"""Places beside a row, in spacings."""
ON = slice(8, 13)  # of these: a row and a tenth of the spacing beside it
BETWEEN = np.r_[0:4, 17:21]
NARROWEST, WIDEST = 0.02, 0.9  # spacing, in widths
LEAST_SEEN = 0.35  # of the heights that a row must pass within the picture
SOME = 0.02  # strength that counts as something
NEAR_ROW = 0.25  # spacings
HALF = 0.5
ALMOST_NOTHING = 1e-6


@dataclass(frozen=True, slots=True)
class RowContrast:
    """How each row stands out, shape (rows,) each, and all of them.

    on: mean strength on a row; contrast: of that against what lies between, -1 to 1; evenness: share of six
    stretches in which the row stands out; between: mean strength there; width: share of the spacing over
    which the rows together are at least half as strong as at their strongest.
    """

    on: Floats
    contrast: Floats
    evenness: Floats
    between: Floats
    width: float


@dataclass(frozen=True)
class PlacedRows:
    """A candidate's rows where they are looked at, in widths and heights of the picture.

    place: shape (rows, heights); spacing: shape (heights,).
    """

    place: Floats
    spacing: Floats

    @cached_property
    def inside(self) -> NDArray[np.bool_]:
        """Where each row lies in the picture, shape (rows, heights)."""
        return np.asarray((self.place >= 0) & (self.place < 1))

    @cached_property
    def seen(self) -> NDArray[np.bool_]:
        """Which rows pass through enough of it, shape (rows,)."""
        return np.asarray(self.inside.mean(axis=1) > LEAST_SEEN)


def placed(candidate: Candidate, width_px: int, height_px: int) -> PlacedRows:
    """Where the rows of a candidate lie in a picture of that size."""
    heights = HEIGHTS * height_px
    place = np.array([np.interp(heights, path[:, 1], path[:, 0]) for path in candidate.paths_px]) / width_px
    spacing = (1 + candidate.convergence * (HEIGHTS - HALF)) / candidate.rows_across
    return PlacedRows(place, spacing.clip(NARROWEST, WIDEST))


def contrast_of(rows: PlacedRows, witness: Witness) -> RowContrast:
    """How the rows stand out of what a witness shows."""
    x = rows.place[:, :, None] + ACROSS * rows.spacing[:, None]
    inside = (x >= 0) & (x < 1)
    value = _sampled(witness, x) * inside
    on = _mean(value[:, :, ON], inside[:, :, ON], 2)
    between = _mean(value[:, :, BETWEEN], inside[:, :, BETWEEN], 2)
    of_row, beside = _mean(on, rows.inside, 1), _mean(between, rows.inside, 1)
    profile = _mean(value, inside, (0, 1))
    return RowContrast(
        of_row,
        (of_row - beside) / (of_row + beside + SOME),
        _evenness(on - between, rows.inside),
        beside,
        float(np.mean(profile > HALF * max(float(profile.max()), ALMOST_NOTHING))),
    )


def explained(rows: PlacedRows, witness: Witness) -> float:
    """The share of what a witness shows that lies near a row."""
    height, width = witness.shape
    shown = witness[(HEIGHTS * height).astype(int)]
    columns = (np.arange(width) + HALF) / width
    off = np.abs(columns - rows.place[:, :, None]).min(axis=0) / rows.spacing[:, None]
    return float(shown[off < NEAR_ROW].sum() / (shown.sum() + 1))


def agreement(rows: PlacedRows, other: PlacedRows) -> float:
    """How far two candidates show the same rows: the harmonic mean of the shares that are the other's."""
    near = HEIGHTS >= HALF
    off = np.abs(rows.place[:, None, near] - other.place[None, :, near]).mean(axis=-1)
    same = off < NEAR_ROW * float(rows.spacing[near].mean())
    ours, theirs = float(same.any(axis=1).mean()), float(same.any(axis=0).mean())
    return 2 * ours * theirs / max(ours + theirs, ALMOST_NOTHING)


def _sampled(witness: Witness, x: Floats) -> Floats:
    """What it shows at places x in widths, shape (rows, heights, n)."""
    height, width = witness.shape
    columns = (x * width - HALF).astype(np.float32)
    lines = np.broadcast_to((HEIGHTS * height - HALF).astype(np.float32)[:, None], x.shape)
    flat = (len(x), -1)
    value = cv2.remap(
        witness,
        columns.reshape(flat),
        np.ascontiguousarray(lines.reshape(flat)),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return np.asarray(value, np.float64).reshape(x.shape)


def _mean(value: Floats, counted: NDArray[np.bool_], axis: int | tuple[int, ...]) -> Floats:
    """The mean over an axis of what is counted; 0 where nothing is."""
    return np.asarray((value * counted).sum(axis=axis) / np.maximum(counted.sum(axis=axis), 1))


def _evenness(standing: Floats, inside: NDArray[np.bool_]) -> Floats:
    stretches = (len(standing), len(HEIGHTS) // STRETCH, STRETCH)
    counted = inside.reshape(stretches)
    stands = _mean(standing.reshape(stretches), counted, 2) > SOME
    return _mean(stands.astype(float), np.asarray(counted.any(axis=2)), 1)
