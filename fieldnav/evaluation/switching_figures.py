"""The figures of `bench switching`, from the switches of every run."""

from collections.abc import Callable, Sequence

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure
from fieldnav.evaluation.switching_runs import Switched
from fieldnav.evaluation.switching_truth import Switch
from fieldnav.messages import Floats

ALL = "all crops"
PERCENT, CENTIMETRES, MOST = 100.0, 100.0, 95.0
HEADLAND_GOAL_M, ENTRY_GOAL_CM, ENTRY_GOAL_DEG = 0.5, 3.0, 2.0
PAPER_SUCCEEDED, PAPER_HEADLAND_M = 90.0, 0.7
PAPER_SIMULATED, PAPER = "paper, simulation, 20 switches", "paper"


def switching_figures(runs: Sequence[Switched]) -> list[Figure]:
    """Success over all and of each crop, then the rest; entries are of those that succeeded."""
    switches = [switch for run in runs for switch in run.switches]
    by_crop: dict[str, list[Switched]] = {}
    for run in runs:
        by_crop.setdefault(run.wanted.run.crop.name, []).append(run)
    figures = _succeeded(ALL, runs, PAPER_SUCCEEDED, PAPER_SIMULATED)
    for crop in sorted(by_crop):
        figures += _succeeded(crop, by_crop[crop])
    return figures + _safety(runs) + _headland(switches) + _entry(switches) + _effort(switches)


def _succeeded(
    case: str, runs: Sequence[Switched], best_known: float | None = None, source: str = ""
) -> list[Figure]:
    attempted = [switch for run in runs for switch in run.switches]
    share = float(np.mean([switch.succeeded for switch in attempted])) if attempted else float("nan")
    return [
        Figure(case, "switches attempted", float(len(attempted))),
        Figure(
            case,
            "switches succeeded (%)",
            share * PERCENT,
            goal=PERCENT,
            best_known=best_known,
            source=source,
        ),
    ]


def _safety(runs: Sequence[Switched]) -> list[Figure]:
    counts: tuple[tuple[str, Callable[[Switched], int]], ...] = (
        ("switches never come to", lambda run: run.attempts_wanted - len(run.switches)),
        ("lanes missed", lambda run: run.lanes_missed),
        ("lanes driven twice", lambda run: run.lanes_repeated),
        ("crop plants run over", lambda run: run.run_over),
    )
    return [
        Figure(ALL, metric, float(sum(count(run) for run in runs)), goal=0.0, better=Better.LOWER)
        for metric, count in counts
    ]


def _headland(switches: Sequence[Switch]) -> list[Figure]:
    used = _finite([switch.headland_m for switch in switches])
    return [
        Figure(
            ALL,
            "headland used, end of crop to camera (m)",
            float(used.mean()),
            float(used.std()),
            HEADLAND_GOAL_M,
            PAPER_HEADLAND_M,
            PAPER,
            Better.LOWER,
        ),
        Figure(ALL, "headland used, most (m)", float(used.max()), better=Better.LOWER),
    ]


def _entry(switches: Sequence[Switch]) -> list[Figure]:
    entered = [switch for switch in switches if switch.succeeded]
    offset_cm = np.abs(_finite([switch.entry_offset_m for switch in entered])) * CENTIMETRES
    angle_deg = np.degrees(np.abs(_finite([switch.entry_angle_rad for switch in entered])))
    return [
        *_spread("entry: distance to the new lane (cm)", offset_cm, ENTRY_GOAL_CM),
        *_spread("entry: angle to the new lane (deg)", angle_deg, ENTRY_GOAL_DEG),
    ]


def _spread(metric: str, sizes: Floats, goal: float) -> list[Figure]:
    return [
        Figure(ALL, metric, float(sizes.mean()), float(sizes.std()), goal, better=Better.LOWER),
        Figure(
            ALL,
            f"{metric}, 95th percentile",
            float(np.percentile(sizes, MOST)),
            goal=goal,
            better=Better.LOWER,
        ),
        Figure(ALL, f"{metric}, worst", float(sizes.max()), goal=goal, better=Better.LOWER),
    ]


def _effort(switches: Sequence[Switch]) -> list[Figure]:
    took_s = _finite([switch.duration_s for switch in switches])
    aside_m = _finite([switch.sideways_m for switch in switches])
    return [
        Figure(ALL, "duration of a switch (s)", float(took_s.mean()), float(took_s.std())),
        Figure(ALL, "way sideways in a switch (m)", float(aside_m.mean()), float(aside_m.std())),
    ]


def _finite(values: Sequence[float]) -> Floats:
    """Those that came to pass, shape (n,); a single NaN where none did."""
    array = np.array(values, dtype=float)
    kept = array[np.isfinite(array)]
    return kept if len(kept) else np.array([np.nan])
