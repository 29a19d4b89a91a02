"""The single rows of a comb: each moved to where its own plants are, and judged by them."""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.bands import LEVEL, Bands
from fieldnav.perception.comb_refinement import EDGE, SAMPLES, off_centre, teeth_of
from fieldnav.perception.row_comb import RowComb

OFFSET_PRIOR = (
    0.1  # standard deviation of a row from its place in the comb, in spacings; drills are not exact
)
TURN_PRIOR = 0.05  # the same of half its lean across the height
TOOTH = 0.5  # of one tooth's vegetation about its row; wide, since the bands of one plant all err alike
WIDTHS = (0.15, 0.12, 0.1)  # standard deviation of the bell about a row in each round, in spacings
LEAST_IN_VIEW = 0.55  # of the height: a row that shows less is not reported
COVERED = 0.05  # strength on a row, beyond twice that between the rows, that shows plants there
NOTHING = 0.02  # strength that is added before a contrast is taken
HALF_TOOTH = SAMPLES // 8


@dataclass(frozen=True, slots=True)
class CombRows:
    """Rows from left to right, shape (rows, ...).

    place: where each lies in each band, in widths, shape (rows, COUNT); contrast: vegetation on the row against
    that between the rows, -1 to 1; coverage: share of the row along which it shows plants; response: of the
    whole comb.
    """

    place: Floats
    contrast: Floats
    coverage: Floats
    response: float

    def __len__(self) -> int:
        return len(self.place)


def rows_of(comb: RowComb, bands: Bands) -> CombRows:
    """The rows of a comb that lie in the picture over most of its height."""
    number = comb.numbers.astype(float)
    offset, turn = np.zeros(len(number)), np.zeros(len(number))
    lean = 2 * LEVEL
    for width in WIDTHS:
        shift = offset[:, None] + turn[:, None] * lean
        off, weight = off_centre(teeth_of(comb, bands, shift), width)
        weight = weight / TOOTH**2
        a, b, c = (
            weight.sum(axis=1) + OFFSET_PRIOR**-2,
            weight @ lean,
            weight @ lean**2 + TURN_PRIOR**-2,
        )
        first = (weight * off).sum(axis=1) - offset / OFFSET_PRIOR**2
        second = (weight * off) @ lean - turn / TURN_PRIOR**2
        determinant = a * c - b * b
        offset = offset + (c * first - b * second) / determinant
        turn = turn + (a * second - b * first) / determinant
    place = comb.middle + (number[:, None] + offset[:, None] + turn[:, None] * lean) * comb.spacing
    kept = (np.abs(place) < 1 / 2).mean(axis=1) >= LEAST_IN_VIEW
    return _judged(comb, bands, place[kept])


def _judged(comb: RowComb, bands: Bands, place: Floats) -> CombRows:
    across = np.linspace(-1 / 2, 1 / 2, SAMPLES) * comb.spacing[:, None]
    value, inside = bands.sample(place[:, :, None] + across)
    middle = slice(SAMPLES // 2 - HALF_TOOTH, SAMPLES // 2 + HALF_TOOTH + 1)
    on = value[:, :, middle].mean(axis=-1)
    between = (value[:, :, :EDGE].mean(axis=-1) + value[:, :, -EDGE:].mean(axis=-1)) / 2
    seen = inside[:, :, SAMPLES // 2] & comb.usable
    count = np.maximum(seen.sum(axis=1), 1)
    mean_on, mean_between = ((seen * part).sum(axis=1) / count for part in (on, between))
    contrast = (mean_on - mean_between) / (mean_on + mean_between + NOTHING)
    coverage = (seen & (on > 2 * between + COVERED)).sum(axis=1) / count
    return CombRows(place, contrast, coverage, comb.response(bands))
