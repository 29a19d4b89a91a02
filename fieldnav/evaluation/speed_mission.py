"""What a simulated mission costs, its pictures drawn and its rows found at full size."""

from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure, Plan
from fieldnav.evaluation.speed_memory import GOAL_MB, memory_mb
from fieldnav.evaluation.speed_samples import CROP, FIELD, ROBOT
from fieldnav.messages import Side
from fieldnav.mission.simulated import Run, simulate
from fieldnav.mission.tick import Tick
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised

REAL_TIME_GOAL, GAZEBO_REAL_TIME, GAZEBO = 4.0, 1.0, "Gazebo at best"
METER_S = 1.0


@dataclass(slots=True)
class Meter:
    """Watches a mission: a row (time, processor's time, memory) a second, so as to hold little itself."""

    rows: list[tuple[float, float, float]]

    def watch(self, tick: Tick) -> None:
        if not self.rows or tick.now_s - self.rows[-1][0] >= METER_S:
            self.rows.append((tick.now_s, process_time(), memory_mb()))


def mission_figures(lanes: int, length_m: float, plan: Plan) -> list[Figure]:
    """A simulated mission, pictures drawn and rows found at full size: how fast, and what memory it takes.

    How memory grows is seen over an hour alone: ten minutes are hardly more than the pictures' caches take
    to fill. See speed_soak.
    """
    field = revised(load_field(FIELD), {"lanes": lanes, "length_m": length_m, "seed": plan.seed})
    meter = Meter([])
    with TemporaryDirectory() as folder:
        run = Run(field, load_crop(CROP), load_robot(ROBOT), lanes, Side.RIGHT, Path(folder))
        simulate(run, [meter])
        one_lane = replace(run, field=revised(field, {"lanes": 1}), lanes=1, record=True)
        recorded = simulate(one_lane).summary.realtime_factor
    now_s, spent_s, held_mb = np.array(meter.rows).T
    factor = float((now_s[-1] - now_s[0]) / (spent_s[-1] - spent_s[0]))
    figures = [
        Figure(
            FIELD, "simulated mission (x real time)", factor, None, REAL_TIME_GOAL, GAZEBO_REAL_TIME, GAZEBO
        ),
        Figure(FIELD, "one lane, recorded, by the clock (x real time)", recorded),
    ]
    if plan.quick or not np.isfinite(held_mb).all():
        return figures
    most_mb = float(held_mb.max())
    return [*figures, Figure(FIELD, "memory, at most (MB)", most_mb, goal=GOAL_MB, better=Better.LOWER)]
