"""`bench row-ends`: is the end of a lane told from a gap, and how well is it met?

Driven over sketched fields without a bus, so that ten kilometres take an hour of one core.
"""

from collections.abc import Sequence
from math import ceil

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure, Plan, Progress
from fieldnav.evaluation.campaign import Failed, run_campaign
from fieldnav.evaluation.row_end_cases import gappy_runs, ragged_runs
from fieldnav.evaluation.row_end_drive import MISSED_M, LaneEnding, LaneRun, drive_to_end
from fieldnav.messages import Floats
from fieldnav.settings.loading import load_robot

ROBOT = "bonnbot"
GAPPY, RAGGED = "gappy rows", "ragged row ends, all crops"
KILOMETRES, LENGTH_M, ENDS_PER_KILOMETRE = 10.0, 200.0, 20
QUICK_LANES, QUICK_LENGTH_M, QUICK_ENDS = 1, 30.0, 2
METRES_PER_KILOMETRE, CENTIMETRES = 1000.0, 100.0

Ending = LaneEnding | Failed[LaneRun]


def row_end_figures(
    plan: Plan, progress: Progress, processes: int = 1, kilometres: float = KILOMETRES
) -> list[Figure]:
    """Kilometres of gappy rows, and twenty ragged ends for each; quick: 50 m in all."""
    robot = load_robot(ROBOT)
    lanes = ceil(kilometres * METRES_PER_KILOMETRE / LENGTH_M)
    lanes, length_m, ends = (
        (QUICK_LANES, QUICK_LENGTH_M, QUICK_ENDS)
        if plan.quick
        else (lanes, LENGTH_M, ceil(kilometres * ENDS_PER_KILOMETRE))
    )
    long = list(gappy_runs(lanes, length_m, plan.seed, robot))
    short = list(ragged_runs(ends, plan.seed, robot))
    driven = run_campaign("lanes to their ends", drive_to_end, [*long, *short], processes, progress)
    goal_km = None if plan.quick else lanes * length_m / METRES_PER_KILOMETRE
    return [*figures_of(GAPPY, driven[:lanes], goal_km), *figures_of(RAGGED, driven[lanes:])]


def figures_of(case: str, driven: Sequence[Ending], goal_km: float | None = None) -> list[Figure]:
    """The figures of some lanes; one whose process failed counts as a stop."""
    lanes = [each for each in driven if isinstance(each, LaneEnding)]
    errors = [lane.error_m for lane in lanes if np.isfinite(lane.error_m)]
    error_m = np.array(errors or [np.nan])
    kilometres = sum(lane.driven_m for lane in lanes) / METRES_PER_KILOMETRE
    stops = len(driven) - len(lanes) + sum(bool(lane.stopped) for lane in lanes)
    return [
        Figure(case, "driven (km)", kilometres, goal=goal_km),
        _none(case, "false ends", sum(lane.false_end for lane in lanes)),
        _none(case, f"ends missed by more than {MISSED_M:g} m", sum(lane.missed for lane in lanes)),
        _worst(case, "worst error of an end (m)", error_m),
        Figure(case, "error of an end, past it (m)", float(error_m.mean()), float(error_m.std())),
        _none(case, "stops", stops),
        Figure(case, "gaps taken for ends until crop came", float(sum(lane.returns for lane in lanes))),
        _cross_track(case, lanes),
    ]


def _none(case: str, metric: str, count: int) -> Figure:
    return Figure(case, metric, float(count), goal=0.0, better=Better.LOWER)


def _worst(case: str, metric: str, error_m: Floats) -> Figure:
    worst_m = float(np.abs(error_m).max())
    return Figure(case, metric, worst_m, goal=MISSED_M, better=Better.LOWER)


def _cross_track(case: str, lanes: Sequence[LaneEnding]) -> Figure:
    offsets = np.concatenate([np.abs(lane.notes.offset_m) for lane in lanes] or [np.empty(0)]) * CENTIMETRES
    mean, std = (float(offsets.mean()), float(offsets.std())) if len(offsets) else (float("nan"), None)
    return Figure(case, "cross-track error (cm)", mean, std, better=Better.LOWER)
