"""The single rows of a comb: each moved to where its own plants are, and how evenly they stand along it."""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import LEVEL, STRETCHES, Bands
from fieldnav.perception.comb.refinement import ACROSS, EDGE, SAMPLES, off_centre, teeth_of
from fieldnav.perception.comb.row_comb import RowComb

OFFSET_PRIOR = 0.1  # standard deviation of a row from its place, in spacings; drills are not exact
TURN_PRIOR = 0.1  # the same of half its lean across the height
WIDTHS = (0.15, 0.1)  # standard deviation of the bell about a row in each round, in spacings
LEAST_IN_VIEW = 0.55  # of the height: a row that shows less is not reported
ALMOST_NOTHING = 1e-6
MIDDLE = slice(SAMPLES // 2 - SAMPLES // 8, SAMPLES // 2 + SAMPLES // 8 + 1)  # samples on a row


@dataclass(frozen=True, slots=True)
class CombRows:
    """Rows from left to right.

    place: where each lies in each band, in widths, shape (rows, bands); evenness: 1 where vegetation stands
    alike along all of a row, less where it stands in some stretches only, shape (rows,); stand: how much
    grows on a row beyond what grows between, against the comb's middle row, shape (rows,).
    """

    place: Floats
    evenness: Floats
    stand: Floats

    def __len__(self) -> int:
        return len(self.place)


def rows_of(comb: RowComb, bands: Bands, scatter: float, in_view: float = LEAST_IN_VIEW) -> CombRows:
    """The rows of a comb that lie in the picture over most of its height.

    scatter: standard deviation of one tooth's vegetation about its row, in spacings; a wide one, since the
    bands of one plant all err alike; in_view: share of the height that a row must show.
    """
    number = comb.numbers.astype(float)
    lean = 2 * LEVEL
    shift = np.zeros((len(number), len(lean)))
    for width in WIDTHS:
        off, weight = off_centre(teeth_of(comb, bands, shift), width)
        shift = _line_through(shift + off, weight / scatter**2, lean)
    place = comb.middle + (number[:, None] + shift) * comb.spacing
    kept = (np.abs(place) < 1 / 2).mean(axis=1) >= in_view
    return CombRows(place[kept], *_standing(comb, bands, place[kept]))


def _line_through(shift: Floats, weight: Floats, lean: Floats) -> Floats:
    """Rows' displacements, shape (rows, bands), as straight lines; short of proof a row keeps its place."""
    a, b, c = (
        weight.sum(axis=1) + OFFSET_PRIOR**-2,
        weight @ lean,
        weight @ lean**2 + TURN_PRIOR**-2,
    )
    first, second = (weight * shift).sum(axis=1), (weight * shift) @ lean
    determinant = a * c - b * b
    offset, turn = (c * first - b * second) / determinant, (a * second - b * first) / determinant
    return np.asarray(offset[:, None] + turn[:, None] * lean)


def _standing(comb: RowComb, bands: Bands, place: Floats) -> tuple[Floats, Floats]:
    """Evenness and stand of rows."""
    value, inside = bands.sample(place[:, :, None] + ACROSS * comb.spacing[:, None])
    on = value[:, :, MIDDLE].mean(axis=-1)
    between = (value[:, :, :EDGE].mean(axis=-1) + value[:, :, -EDGE:].mean(axis=-1)) / 2
    seen = (inside[:, :, SAMPLES // 2] & comb.usable).astype(float)
    standing = (seen * (on - between)) @ STRETCHES.T / np.maximum(seen @ STRETCHES.T, 1)
    mean = np.maximum(standing.mean(axis=1), 0)
    evenness = np.clip(standing / np.maximum(mean, ALMOST_NOTHING)[:, None], 0, 1).mean(axis=1)
    middle = float(np.median(mean)) if len(mean) else 0.0
    return evenness * (mean > 0), mean / max(middle, ALMOST_NOTHING)
