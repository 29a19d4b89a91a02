"""The figures of `bench navigation`: those of one field beside each other, a row a configuration."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure
from fieldnav.evaluation.navigation_cases import Case, Errors, Spread
from fieldnav.evaluation.navigation_configurations import Configuration
from fieldnav.evaluation.navigation_lane import Lane
from fieldnav.messages import Floats

CENTIMETRES, PERCENT = 100.0, 100.0


@dataclass(frozen=True, slots=True)
class Measure:
    """A figure that is a mean over the seeds, or the worst or the sum of them."""

    metric: str
    of: Callable[[Lane], float]
    joined: Callable[[Floats], float]
    goal: float | None = None
    better: Better = Better.LOWER
    spread: bool = False


def _mean(values: Floats) -> float:
    return float(values.mean())


def _most(values: Floats) -> float:
    return float(values.max())


def _sum(values: Floats) -> float:
    return float(values.sum())


MEASURES = (
    Measure("largest cross-track error (cm)", lambda lane: lane.largest_offset_m * CENTIMETRES, _most),
    Measure("largest heading error (deg)", lambda lane: float(np.degrees(lane.largest_heading_rad)), _most),
    Measure(
        "offset to the left, mean and std of the seeds (cm)",
        lambda lane: float(np.nanmean(lane.offset_m)) * CENTIMETRES if lane.share_driven else float("nan"),
        _mean,
        spread=True,
    ),
    Measure("crop plants run over", lambda lane: lane.run_over, _sum, 0.0),
    Measure("length driven (%)", lambda lane: lane.share_driven * PERCENT, _mean, PERCENT, Better.HIGHER),
    Measure("stops", lambda lane: lane.stops, _sum, 0.0),
    Measure("yaw jerk, rms (deg/s3)", lambda lane: float(np.degrees(lane.yaw_jerk_rps3)), _mean),
    Measure(
        "steering rate of the wheels, rms (deg/s)",
        lambda lane: float(np.degrees(lane.steering_rate_rps)),
        _mean,
    ),
    Measure("real-time factor, runs side by side", lambda lane: lane.realtime_factor, _mean),
)


def case_figures(case: Case, lanes: Sequence[Lane]) -> list[Figure]:
    """The figures of a case; goals hold for the default alone, the paper's values stand beside all."""
    ways = [way for way in Configuration if any(lane.drive.configuration is way for lane in lanes)]
    driven = {way: [lane for lane in lanes if lane.drive.configuration is way] for way in ways}
    figures = [distance_figure(case, way, driven[way]) for way in ways]
    figures += [angle_figure(case, way, driven[way]) for way in ways]
    return figures + [_figure(measure, case, way, driven[way]) for measure in MEASURES for way in ways]


def distance_figure(case: Case, way: Configuration, lanes: Sequence[Lane]) -> Figure:
    """Distance from the lane's centre line: mean and standard deviation over the length of all seeds."""
    ours = spread(np.concatenate([lane.offset_m for lane in lanes]) * CENTIMETRES)
    return _error("cross-track error (cm)", case, way, ours, lambda errors: errors.distance_cm)


def angle_figure(case: Case, way: Configuration, lanes: Sequence[Lane]) -> Figure:
    """The same of the angle to it."""
    ours = spread(np.degrees(np.concatenate([lane.heading_rad for lane in lanes])))
    return _error("heading error (deg)", case, way, ours, lambda errors: errors.angle_deg)


def spread(signed: Floats) -> Spread:
    """Mean and deviation of the size of errors, shape (n,); those that are NaN do not count."""
    sizes = np.abs(signed[np.isfinite(signed)])
    if not len(sizes):
        return Spread(float("nan"), float("nan"))
    return Spread(float(sizes.mean()), float(sizes.std()))


def _error(
    metric: str, case: Case, way: Configuration, ours: Spread, of: Callable[[Errors], Spread]
) -> Figure:
    goal = of(case.goal) if way is Configuration.DEFAULT else None
    paper = of(case.paper) if case.paper else None
    return Figure(
        case=titled(case, way),
        metric=metric,
        value=ours.mean,
        std=ours.std,
        goal=goal.mean if goal else None,
        goal_std=goal.std if goal else None,
        best_known=paper.mean if paper else None,
        source=f"{case.measured}, +- {paper.std:g}" if paper else "",
        better=Better.LOWER,
    )


def _figure(measure: Measure, case: Case, way: Configuration, lanes: Sequence[Lane]) -> Figure:
    values = np.array([measure.of(lane) for lane in lanes], dtype=float)
    return Figure(
        case=titled(case, way),
        metric=measure.metric,
        value=measure.joined(values),
        std=float(values.std()) if measure.spread else None,
        goal=measure.goal if way is Configuration.DEFAULT else None,
        better=measure.better,
    )


def titled(case: Case, way: Configuration) -> str:
    """The case's name, and how it was driven where that is not the default."""
    return case.name if way is Configuration.DEFAULT else f"{case.name} ({way.value})"
