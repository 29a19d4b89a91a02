"""Where on the ground a comb of rows holds the most plants: a search over its offset and heading.

Lines of single windows err where rows have two or three plants, or fewer plants than there are weeds; all
rows together do not.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import uniform_filter1d

from fieldnav.messages import Floats
from fieldnav.perception.ground_plants import GroundPlants

BIN_M = 0.01
REACH_M = 2.0  # to either side of the robot's line: wider than any view
STEEPEST = 0.25  # tangent of the greatest angle between robot and rows, 14 degrees
SLOPE_STEP = 0.02
CENTRED_BONUS = 0.2  # a lane under the robot's middle scores by so much more than one at the bound


@dataclass(frozen=True, slots=True)
class Support:
    """How many plants stand on a comb at every offset and slope: score of shape (slopes, offsets)."""

    score: Floats
    slopes: Floats
    offsets_m: Floats

    def best(self) -> tuple[float, float, float]:
        """Offset, slope and score of the best comb."""
        slope, offset = np.unravel_index(int(self.score.argmax()), self.score.shape)
        return float(self.offsets_m[offset]), float(self.slopes[slope]), float(self.score[slope, offset])

    def near(self, offset_m: float, slope: float) -> float:
        """The best score next to an offset and a slope; 0 off the table."""
        row = np.abs(self.slopes - slope) <= SLOPE_STEP
        column = np.abs(self.offsets_m - offset_m) <= 2 * BIN_M
        return float(self.score[np.ix_(row, column)].max(initial=0.0))


def support(plants: GroundPlants, place_m: Floats, about_m: float, near_m: float, bound_m: float) -> Support:
    """Score combs whose middle passes within `bound_m` of the robot's line at the distance `near_m`.

    A comb's score adds the square roots of its rows' weights: a second row counts more than a denser one.
    Offsets are those at the distance `about_m`; place_m: the rows against the comb's middle, shape (rows,).
    """
    steps = round(STEEPEST / SLOPE_STEP)
    slopes: Floats = np.asarray(SLOPE_STEP * np.arange(-steps, steps + 1), dtype=float)
    bins = 2 * round(REACH_M / BIN_M) + 1
    x, y = plants.position_m.T
    off = y - slopes[:, None] * (x - about_m)
    inside = np.abs(off) < REACH_M
    index = np.where(inside, np.round(off.clip(-REACH_M, REACH_M) / BIN_M).astype(int) + bins // 2, 0)
    index += np.arange(len(slopes))[:, None] * bins
    weight = np.where(inside, plants.weight, 0.0)
    held = np.bincount(index.ravel(), weight.ravel(), len(slopes) * bins).reshape(len(slopes), bins)
    width = 2 * round(float(np.median(plants.half_width_m)) / 2 / BIN_M) + 1
    held = width * uniform_filter1d(uniform_filter1d(held, width, mode="constant"), width, mode="constant")
    widest = bound_m + STEEPEST * abs(near_m - about_m)
    reach = int(widest / BIN_M)
    offsets: Floats = np.asarray(BIN_M * np.arange(-reach, reach + 1), dtype=float)
    at = np.round((offsets[:, None] + place_m) / BIN_M).astype(int) + bins // 2
    rows = np.sqrt(held[:, at.clip(0, bins - 1)].clip(0)).sum(axis=-1)
    middle = offsets + slopes[:, None] * (near_m - about_m)
    bonus = 1 - CENTRED_BONUS * (middle / bound_m) ** 2
    return Support(np.where(np.abs(middle) <= bound_m, rows * bonus, 0.0), slopes, offsets)
