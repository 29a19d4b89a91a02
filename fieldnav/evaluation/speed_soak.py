"""One hour of a mission, on a sketched field of many lanes: whether its memory or its loop's cost grows."""

from array import array
from dataclasses import dataclass, field

import numpy as np

from fieldnav.evaluation.benchmark import Better, Failure, Figure, Plan, Progress, Report
from fieldnav.evaluation.path import PathObserver
from fieldnav.evaluation.speed_loop import EARLY, LATE_GOAL, PERCENTILE
from fieldnav.evaluation.speed_memory import GOAL_MB, HOUR_S, MEGABYTE, growth_mb, memory_mb
from fieldnav.evaluation.speed_rig import Rig, Round, rigged
from fieldnav.evaluation.speed_samples import FIELD
from fieldnav.evaluation.speed_timing import MILLISECONDS, one_thread
from fieldnav.messages import Floats
from fieldnav.mission.figures import Figures
from fieldnav.mission.loop import TICK_S
from fieldnav.mission.tick import Observer, Tick
from fieldnav.settings.loading import load_field, revised
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import World
from states.names import text

LANES, LENGTH_M = 60, 30.0  # a lane and the way to the next take some 85 s
NO_WEEDS = {"per_m2": 0.0}
"""A sketch draws weeds much as it draws the crop, and a lane is refused with a row in a wheel's way."""
QUICK_S = 30.0
WARM_S = 600.0
SETTLED = 1 / 3  # of the time, after which memory must not grow
SAMPLE_S, MINUTE_S = 1.0, 60.0
CASE, AGAIN = f"{FIELD}, sketched", "fieldnav bench speed --hour"


@dataclass(slots=True)
class Soaked:
    """What was noted: a row (time, memory) a second, and the ms of the rounds that tracked."""

    memory: "array[float]" = field(default_factory=lambda: array("d"))
    spent_ms: "array[float]" = field(default_factory=lambda: array("d"))
    rounds: int = 0
    now_s: float = 0.0

    def note(self, done: Round) -> None:
        """Take in one round of the loop."""
        self.rounds, self.now_s = self.rounds + 1, done.now_s
        if done.tracked:
            self.spent_ms.append(done.spent_s * MILLISECONDS)
        if not self.memory or done.now_s - self.memory[-2] >= SAMPLE_S:
            self.memory.extend((done.now_s, memory_mb()))


class LastWord:
    """Watches for why the mission went where it is, to be told should it end too soon."""

    def __init__(self) -> None:
        self.said = ""

    def watch(self, tick: Tick) -> None:
        if tick.change is not None:
            self.said = f"{text(tick.state)} in lane {tick.lane} after {tick.now_s:.1f} s: {tick.reason}"


def soak_report(plan: Plan, progress: Progress) -> Report:
    """Drive for an hour of the robot's time; what it held in memory and what its rounds cost."""
    until_s = QUICK_S if plan.quick else HOUR_S
    changes = {"lanes": LANES, "length_m": LENGTH_M, "weeds": NO_WEEDS, "seed": plan.seed}
    paths, last = [], LastWord()

    def watch(world: World) -> list[Observer]:
        paths.append(PathObserver(world))
        return [Figures(LANES), last, *paths]

    with one_thread(), rigged(revised(load_field(FIELD), changes), SketchRenderer, watch) as rig:
        soaked = soak(rig, until_s, progress)
    path_mb = paths[0].path.held_bytes / MEGABYTE
    figures = (
        Figure(CASE, "simulated (s)", soaked.now_s, goal=until_s),
        Figure(CASE, "rounds of the loop", soaked.rounds),
        *memory_figures(np.array(soaked.memory).reshape(-1, 2), path_mb),
        *cost_figures(np.array(soaked.spent_ms)),
    )
    whole = soaked.now_s >= until_s
    return Report(figures, failures=() if whole else (Failure(CASE, last.said, AGAIN),))


def soak(rig: Rig, until_s: float, progress: Progress) -> Soaked:
    """Drive until then, telling of each minute."""
    soaked, minutes = Soaked(), round(until_s / MINUTE_S)
    for done in rig.rounds(until_s):
        soaked.note(done)
        if done.now_s % MINUTE_S < TICK_S:
            progress("speed: one hour", min(int(done.now_s / MINUTE_S), minutes), minutes)
    return soaked


def memory_figures(memory: Floats, path_mb: float) -> list[Figure]:
    """Of rows (time, MB held), shape (n, 2); none for a time in which nothing comes to rest.

    path_mb: what the simulation keeps of the true path, to judge by; a robot keeps none.
    """
    now_s, held_mb = memory.T
    if now_s[-1] < WARM_S or not np.isfinite(held_mb).all():
        return []
    low = Better.LOWER
    warm_mb, end_mb = held_mb[np.searchsorted(now_s, WARM_S)], held_mb[-1]
    return [
        Figure(CASE, f"memory after {WARM_S / MINUTE_S:.0f} minutes (MB)", warm_mb, better=low),
        Figure(CASE, "memory at the end (MB)", end_mb, goal=GOAL_MB, better=low),
        Figure(CASE, "of that the true path, which a robot does not keep (MB)", path_mb, better=low),
        Figure(
            CASE,
            "memory, growth in an hour, over the last two thirds (MB)",
            growth_mb(now_s, held_mb, SETTLED),
            better=low,
        ),
    ]


def cost_figures(spent_ms: Floats) -> list[Figure]:
    """Of the rounds that tracked, shape (n,): the first quarter of them, the last, and one over the other."""
    part = max(1, int(len(spent_ms) * EARLY))
    times = {"early": spent_ms[:part], "late": spent_ms[-part:]}
    low, figures = Better.LOWER, []
    for when, spent in times.items():
        middle, worst = float(np.median(spent)), float(np.percentile(spent, PERCENTILE))
        figures += [
            Figure(CASE, f"frame in to CAN frame out, {when}, median (ms)", middle, better=low),
            Figure(CASE, f"frame in to CAN frame out, {when}, 99th percentile (ms)", worst, better=low),
        ]
    growth = float(np.median(times["late"]) / np.median(times["early"]))
    return [*figures, Figure(CASE, "cost of a frame late over early", growth, goal=LATE_GOAL, better=low)]
