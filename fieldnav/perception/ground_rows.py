"""A joint fit of parallel rows to the plants inside their parallelograms, on the ground (paper III-A.3)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats, RowLine
from fieldnav.perception.ground_plants import GroundPlants
from fieldnav.pinhole import Pinhole

Indices = NDArray[np.int64]

OFFSET_PRIOR_M = 0.1  # standard deviation of the lane's movement sideways between two frames
SLOPE_PRIOR = 0.1  # the same of its heading
ROW_OFFSET_PRIOR_M = 0.02  # of one row's place against the lane
ROW_SLOPE_PRIOR = 0.012  # of one row's heading against the lane's: rows are parallel
HUBER = 1.5  # residuals beyond so many standard deviations count linearly
ROUNDS = 3  # of reweighting


@dataclass(frozen=True, slots=True)
class GroundRows:
    """Parallel rows on the ground, about a distance `about_m` ahead.

    Row i is y = offset_m + place_m[i] + (slope + turn[i]) (x - about_m). place_m: shape (rows,), where the
    row lies against the lane's middle; turn: shape (rows,), how its heading differs from the lane's.
    """

    offset_m: float
    slope: float
    place_m: Floats
    turn: Floats
    about_m: float

    def lines(self) -> Floats:
        """Offset at `about_m` and slope of each row, shape (rows, 2)."""
        return np.stack([self.offset_m + self.place_m, self.slope + self.turn], axis=-1)

    def residual_m(self, plants: GroundPlants) -> Floats:
        """How far left of each row each plant stands, shape (rows, n)."""
        offset, slope = self.lines().T
        x, y = plants.position_m.T
        return np.asarray(y - offset[:, None] - slope[:, None] * (x - self.about_m))

    def in_image(self, confidence: Floats, plane: Pinhole) -> tuple[RowLine, ...]:
        """The rows as lines of the image; confidence: shape (rows,)."""
        return tuple(
            plane.row_in_image(float(offset - slope * self.about_m), float(slope), float(sure))
            for (offset, slope), sure in zip(self.lines(), confidence, strict=True)
        )


def members(comb: GroundRows, plants: GroundPlants, widest_m: float, wider: float = 1.0) -> Indices:
    """The row in whose parallelogram each plant stands, -1 where none; shape (n,).

    wider: scales the parallelogram; half its width is never more than `widest_m`.
    """
    off = np.abs(comb.residual_m(plants))
    reach = np.minimum(plants.half_width_m * wider, widest_m)
    return np.where(off.min(axis=0) <= reach, off.argmin(axis=0), -1)


def fit(
    comb: GroundRows,
    plants: GroundPlants,
    row: Indices,
    scatter_m: float,
    row_offset_prior_m: float = ROW_OFFSET_PRIOR_M,
) -> GroundRows:
    """The comb that the plants show, starting from where it was.

    A regularised least squares with Huber's weights: the lane may move and turn freely, each row but little
    against it, so a row with few plants, or none, goes along with the others.
    row: the row of each plant, -1 for none; scatter_m: standard deviation of a whole plant from its row.
    """
    inside = row >= 0
    if not inside.any():
        return comb
    row, weight = row[inside], plants.weight[inside]
    rows = len(comb.place_m)
    residual = comb.residual_m(plants)[row, np.flatnonzero(inside)]
    ahead = plants.position_m[inside, 0] - comb.about_m
    mine = np.equal.outer(row, np.arange(rows)).astype(float)
    design = np.hstack([np.ones((len(row), 1)), ahead[:, None], mine, mine * ahead[:, None]])
    loose = np.repeat([OFFSET_PRIOR_M, SLOPE_PRIOR, row_offset_prior_m, ROW_SLOPE_PRIOR], [1, 1, rows, rows])
    prior = np.diag(loose**-2.0)
    change: Floats = np.zeros(len(loose))
    for _ in range(ROUNDS):
        off = np.abs(residual - design @ change) * np.sqrt(weight) / scatter_m
        trust = weight / scatter_m**2 * np.minimum(1.0, HUBER / np.maximum(off, HUBER))
        weighted = design.T * trust
        change = np.asarray(np.linalg.solve(weighted @ design + prior, weighted @ residual))
    return GroundRows(
        comb.offset_m + float(change[0]),
        comb.slope + float(change[1]),
        comb.place_m + change[2 : 2 + rows],
        comb.turn + change[2 + rows :],
        comb.about_m,
    )
