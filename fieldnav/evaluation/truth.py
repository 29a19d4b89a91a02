"""The figures of a simulated run against its ground truth."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fieldnav.evaluation.path import PathObserver
from fieldnav.journal.summary import CrossTrack, Heading, Headland, Truth
from fieldnav.messages import Direction, Floats
from fieldnav.simulation.world import World
from states.names import Phase, Sidestep, direction_of

CELL_M = 0.25
COVERED = 0.95
"""Share of a lane's length that must have been driven for the lane to count as done."""
HALF = 0.5
CENTIMETRES = 100.0
PERCENTILE = 95


@dataclass(frozen=True, slots=True)
class Driven:
    """The ticks within the rows: the true lane that was nearest, the place along it, the errors."""

    lane: NDArray[np.int64]
    believed: NDArray[np.int64]
    s_m: Floats
    offset_m: Floats
    heading_rad: Floats


def driven(world: World, observer: PathObserver) -> Driven:
    """Judge each tick of following and leaving whose place lies within its lane's rows."""
    plan, path = world.plan, observer.path
    keep = np.array([bool({Phase.FOLLOW, Phase.EXIT} & set(state)) for state in path.states], dtype=bool)
    xy, heading = path.xy()[keep], np.array(path.heading_rad)[keep]
    places = [plan.in_lane(lane, xy) for lane in range(plan.lanes)]
    s, offset, along = (np.stack([place[i] for place in places]) for i in range(3))
    nearest = np.abs(offset).argmin(axis=0)
    pick = (nearest, np.arange(len(nearest)))
    first, last = plan.s_first_m.mean(axis=1)[nearest], plan.s_last_m.mean(axis=1)[nearest]
    turned = heading - along[pick]
    turned = np.arctan2(np.sin(turned), np.cos(turned))
    inside = (s[pick] >= first) & (s[pick] <= last)
    believed = np.array(path.lanes)[keep]
    return Driven(nearest[inside], believed[inside], s[pick][inside], offset[pick][inside], turned[inside])


def judge(world: World, observer: PathObserver, lanes: int) -> Truth:
    """The figures of summary.json; `lanes` were to be driven."""
    run = driven(world, observer)
    missed, repeated = _coverage(world, run, lanes)
    offset_cm, turned_deg = np.abs(run.offset_m) * CENTIMETRES, np.degrees(np.abs(run.heading_rad))
    if not len(offset_cm):
        offset_cm, turned_deg = np.array([np.nan]), np.array([np.nan])
    return Truth(
        cross_track_cm=CrossTrack(
            mean=_rounded(offset_cm.mean()),
            std=_rounded(offset_cm.std()),
            p95=_rounded(np.percentile(offset_cm, PERCENTILE)),
            max=_rounded(offset_cm.max()),
        ),
        heading_deg=Heading(
            mean=_rounded(turned_deg.mean()), std=_rounded(turned_deg.std()), max=_rounded(turned_deg.max())
        ),
        crop_plants_run_over=len(observer.run_over),
        lanes_missed=missed,
        lanes_repeated=repeated,
    )


def headland(world: World, observer: PathObserver) -> Headland:
    """Empty space used: from the end of a lane's longest row to the trailing camera at the sidestep."""
    plan, path = world.plan, observer.path
    used = []
    for index, state in enumerate(path.states):
        direction = direction_of(state)
        if direction is None or state[-1] is not Sidestep.SAMPLING or path.states[index - 1] == state:
            continue
        at = np.array([path.x_m[index], path.y_m[index]])
        places = [plan.in_lane(lane, at) for lane in range(plan.lanes)]
        lane = int(np.argmin([abs(float(place[1])) for place in places]))
        camera_m = world.robot.cameras.get(direction.trailing).distance_m
        s = float(places[lane][0])
        if direction is Direction.FORWARD:
            used.append(s - camera_m - float(plan.s_last_m[lane].max()))
        else:
            used.append(float(plan.s_first_m[lane].min()) - s - camera_m)
    if not used:
        return Headland()
    return Headland(mean=_rounded(np.mean(used)), max=_rounded(np.max(used)))


def _coverage(world: World, run: Driven, lanes: int) -> tuple[int, int]:
    """How many of the lanes to be driven were missed, and how many of all were driven more than once."""
    missed = repeated = 0
    for lane in range(world.plan.lanes):
        here = run.lane == lane
        length_m = float(world.plan.s_last_m[lane].mean() - world.plan.s_first_m[lane].mean())
        cells = length_m / CELL_M
        shares = [
            len(np.unique(np.floor(run.s_m[here & (run.believed == number)] / CELL_M))) / cells
            for number in np.unique(run.believed)
        ]
        missed += lane < lanes and max(shares, default=0.0) < COVERED
        repeated += sum(share > HALF for share in shares) > 1
    return missed, repeated


def _rounded(value: "float | np.floating[Any]") -> float | None:
    """Three decimals are below what any of these figures can bear."""
    return round(float(value), 3) if np.isfinite(value) else None
