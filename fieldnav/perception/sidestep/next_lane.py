"""Where the next lane is: the place at which a lane's rows explain best what was seen and what was not.

Rows are not counted one by one: a row that was not sown or that begins too late to be seen must not shift the
count. Every place of the lane's middle is weighed by the rows at the places that its rows should have, by the
empty places among them, and by where the lane is expected.
"""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.lane import comb_m
from fieldnav.perception.sidestep.lane_odds import Expected, evidence, goes_on, prior
from fieldnav.perception.sidestep.passing_rows import Crossing
from fieldnav.perception.sidestep.row_words import words
from fieldnav.settings.crop import CropProfile

STEP_M = 0.01
LEAST_GAP = 0.75
"""Of the row spacing: lanes do not overlap, so the next one's first row is at least this far."""
ONE_PLACE = 0.3
"""Of the row spacing: places nearer to each other than this are one."""


@dataclass(frozen=True, slots=True)
class NextLane:
    """A lane: its middle's distance from the robot, outward; its distance from the old lane; how likely.

    rows: for each place of a row, from the inside outward, the index of the row seen there, -1 for none;
    outermost_m: where its last row is or should be.
    """

    middle_m: float
    pitch_m: float
    probability: float
    rows: tuple[int, ...]
    outermost_m: float

    @property
    def rows_seen(self) -> int:
        return sum(row >= 0 for row in self.rows)


def old_lane_m(crossing: Crossing, crop: CropProfile) -> float:
    """Distance outward from the robot to the middle of the lane that it left."""
    old = np.sort([row.across_m for row in crossing.rows if row.of_old_lane])
    comb = comb_m(crop)[::-1]
    return float(np.mean(old - comb)) if len(old) == len(comb) else float(np.mean(old))


def next_lane(crossing: Crossing, expected: Expected, crop: CropProfile) -> NextLane | None:
    """The likeliest place of the next lane; None while no new row is certain."""
    certain = [index for index in crossing.new if words(crossing, index, crop).certain]
    old_m, comb = old_lane_m(crossing, crop), comb_m(crop)[::-1]
    nearest_m = (len(comb) - 1 + LEAST_GAP) * crop.rows.spacing_m
    if not certain or expected.longest_m <= nearest_m:
        return None
    pitch: Floats = np.asarray(np.arange(nearest_m, expected.longest_m, STEP_M), dtype=float)
    score = prior(pitch, expected, crop) + evidence(crossing, old_m, pitch, comb, crop)
    best = int(score.argmax())
    share = np.exp(score - score[best])
    here = np.abs(pitch - pitch[best]) < ONE_PLACE * crop.rows.spacing_m
    probability = float(share[here].sum() / share.sum())
    return _placed(crossing, old_m, float(pitch[best]), probability, certain, crop)


def rows_beside(crossing: Crossing, lane: NextLane, crop: CropProfile) -> int:
    """How many certain rows stand where a lane's rows would go on, which is where the wheels will go."""
    count = crop.rows.per_lane
    if count == 1 or goes_on(lane.pitch_m, crop):  # these rows are of the lanes beside
        return 0
    beside = (count + 1) / 2 * crop.rows.spacing_m
    places = lane.middle_m + np.array([-beside, beside])
    certain = [
        crossing.rows[index].across_m for index in crossing.new if words(crossing, index, crop).certain
    ]
    near = np.abs(np.array(certain)[:, None] - places) < ONE_PLACE * crop.rows.spacing_m
    return int(near.any(axis=0).sum())


def _placed(
    crossing: Crossing,
    old_m: float,
    pitch_m: float,
    probability: float,
    certain: list[int],
    crop: CropProfile,
) -> NextLane:
    """The lane with the certain rows nearest its places; its middle is theirs."""
    comb = comb_m(crop)[::-1]
    rows = []
    for place in old_m + pitch_m + comb:
        nearest = min(certain, key=lambda index: abs(crossing.rows[index].across_m - place))
        near = abs(crossing.rows[nearest].across_m - place) < ONE_PLACE * crop.rows.spacing_m
        rows.append(nearest if near else -1)
    off = [crossing.rows[row].across_m - place for row, place in zip(rows, comb, strict=True) if row >= 0]
    middle_m = float(np.mean(off)) if off else old_m + pitch_m
    last = crossing.rows[rows[-1]].across_m if rows[-1] >= 0 else middle_m + float(comb[-1])
    return NextLane(middle_m, middle_m - old_m, probability, tuple(rows), last)
