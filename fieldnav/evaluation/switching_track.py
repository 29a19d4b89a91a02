"""A lane switch as a small track: outward beyond the row ends and across towards the next lane."""

from dataclasses import dataclass

import numpy as np

from fieldnav.evaluation.path import TruePath
from fieldnav.messages import Direction, Floats
from fieldnav.simulation.plan import FieldPlan

BEFORE_TICKS, AFTER_TICKS, EVERY = 200, 150, 10
"""Shown of the exit before a switch and of the following after it, 4 s and 3 s; one tick in ten."""


@dataclass(frozen=True, slots=True)
class SwitchTrack:
    """Positions in metres: outward from the mean end of the lane that was left, across towards the next.

    outward_m, across_m, heading_rad: shape (n,); heading from the outward direction towards the next lane;
    leaves: the state's innermost name at each point.
    rows_across_m, rows_end_m: shape (rows,), where each row of both lanes runs and ends.
    """

    outward_m: Floats
    across_m: Floats
    heading_rad: Floats
    leaves: tuple[str, ...]
    rows_across_m: Floats
    rows_end_m: Floats


def track(
    plan: FieldPlan, lane: int, direction: Direction, path: TruePath, start: int, end: int
) -> SwitchTrack:
    """The track of the switch from `lane` whose sidestep lasts from tick `start` up to tick `end`."""
    shown = np.arange(max(0, start - BEFORE_TICKS), min(len(path.states), end + AFTER_TICKS), EVERY)
    xy = np.stack([np.array(path.x_m)[shown], np.array(path.y_m)[shown]], axis=1)
    forward = direction is Direction.FORWARD
    ends_m = plan.s_last_m if forward else plan.s_first_m
    out, origin_m = (1, float(ends_m[lane].mean())) if forward else (-1, float(ends_m[lane].mean()))
    side = _side(plan)
    s, n, along = plan.centreline.project(xy)
    middle_n = float(plan.rows.lane_n(lane, origin_m))
    turned = np.array(path.heading_rad)[shown] - along
    lanes = [each for each in (lane, lane + 1) if each < plan.lanes]
    rows = [(each, row) for each in lanes for row in range(plan.rows_per_lane)]
    return SwitchTrack(
        outward_m=out * (s - origin_m),
        across_m=side * (n - middle_n),
        heading_rad=turned * out * side,
        leaves=tuple(str(path.states[index][-1].value) for index in shown),
        rows_across_m=np.array([side * (float(plan.rows.row_n(*of, ends_m[of])) - middle_n) for of in rows]),
        rows_end_m=np.array([out * (float(ends_m[of]) - origin_m) for of in rows]),
    )


def _side(plan: FieldPlan) -> int:
    """The sign of n towards the next lane."""
    return 1 if plan.lanes == 1 or plan.rows.lane_n_m[1] > plan.rows.lane_n_m[0] else -1
