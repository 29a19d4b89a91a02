"""One lane of `bench navigation`: driven in a process of its own, and what the bench keeps of it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import savgol_filter

from fieldnav.evaluation.campaign_run import drive
from fieldnav.evaluation.navigation_cases import Case
from fieldnav.evaluation.navigation_configurations import Configuration
from fieldnav.evaluation.path import TruePath
from fieldnav.evaluation.truth import COVERED, driven
from fieldnav.messages import Floats
from fieldnav.mission.loop import TICK_S
from fieldnav.mission.simulated import Run
from states.names import Phase

CELL_M = 0.1
"""Lanes are judged in cells of this length, so that a robot that stands still does not count for more."""
SMOOTHED_TICKS, SMOOTHED_ORDER = 25, 3
"""Jerk is that of a cubic through half a second (Savitzky, Golay 1964): a motor's steps are no jerk."""


@dataclass(frozen=True, slots=True)
class Drive:
    """A lane to be driven."""

    case: Case
    configuration: Configuration
    run: Run


@dataclass(frozen=True, slots=True)
class Lane:
    """A lane that was driven, judged by where the robot truly was.

    offset_m, heading_rad: shape (cells,), the mean over each cell of the lane, positive to the left,
    NaN where the robot never was; the largest of both are of single moments.
    yaw_jerk_rps3: rms of the yaw rate's second derivative; steering_rate_rps: rms over time and wheels.
    """

    drive: Drive
    offset_m: Floats
    heading_rad: Floats
    largest_offset_m: float
    largest_heading_rad: float
    yaw_jerk_rps3: float
    steering_rate_rps: float
    run_over: int
    stops: int
    realtime_factor: float
    reason: str = ""

    @property
    def share_driven(self) -> float:
        return float(np.isfinite(self.offset_m).mean())


def drive_lane(wanted: Drive) -> Lane:
    """Drive a lane and judge it. Raises FieldnavError."""
    done = drive(wanted.run)
    observer, summary = done.observer, done.summary
    plan, path = observer.world.plan, observer.path
    truth = driven(observer.world, observer)
    first_m, last_m = float(plan.s_first_m[0].mean()), float(plan.s_last_m[0].mean())
    offset_m = by_cell(truth.s_m - first_m, truth.offset_m, last_m - first_m)
    early = ended_early(summary.completed, float(np.isfinite(offset_m).mean()))
    return Lane(
        drive=wanted,
        offset_m=offset_m,
        heading_rad=by_cell(truth.s_m - first_m, truth.heading_rad, last_m - first_m),
        largest_offset_m=float(np.abs(truth.offset_m).max(initial=0.0)),
        largest_heading_rad=float(np.abs(truth.heading_rad).max(initial=0.0)),
        yaw_jerk_rps3=yaw_jerk_rps3(path),
        steering_rate_rps=steering_rate_rps(path),
        run_over=len(observer.run_over),
        stops=max(summary.faults, int(not summary.completed or bool(early))),
        realtime_factor=summary.realtime_factor,
        reason=done.reason or early,
    )


def ended_early(completed: bool, share_driven: float) -> str:
    """What is wrong with a mission that finishes within the rows, so that a person must help; else empty."""
    if not completed or share_driven >= COVERED:
        return ""
    return f"the lane was taken for ended after {share_driven:.0%} of it"


def by_cell(along_m: Floats, values: Floats, length_m: float) -> Floats:
    """Mean of the values, shape (n,), in each cell of a lane, NaN where there is none; shape (cells,)."""
    cells = max(1, int(length_m / CELL_M))
    index = np.clip((along_m / CELL_M).astype(np.int64), 0, cells - 1)
    counts = np.bincount(index, minlength=cells)
    sums = np.bincount(index, values, minlength=cells)
    means: Floats = np.divide(sums, counts, out=np.full(cells, np.nan), where=counts > 0)
    return means


def yaw_jerk_rps3(path: TruePath) -> float:
    """Root mean square over the following, rad/s3; NaN for a path too short to smooth."""
    following = _following(path)
    if following.sum() < SMOOTHED_TICKS:
        return float("nan")
    rates = np.array(path.yaw_rate_rps)
    jerk = savgol_filter(rates, SMOOTHED_TICKS, SMOOTHED_ORDER, deriv=2, delta=TICK_S)
    return float(np.sqrt(np.mean(jerk[following] ** 2)))


def steering_rate_rps(path: TruePath) -> float:
    """Root mean square over the following and the wheels, rad/s; NaN where there was none."""
    following = _following(path)
    rates = np.array(path.steering_rate_rps)[following]
    return float(np.sqrt(np.mean(rates**2))) if len(rates) else float("nan")


def _following(path: TruePath) -> NDArray[np.bool_]:
    return np.array([Phase.FOLLOW in state for state in path.states], dtype=bool)
