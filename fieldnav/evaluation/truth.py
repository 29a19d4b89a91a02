"""The figures of a simulated run against its ground truth."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fieldnav.evaluation.path import PathObserver
from fieldnav.journal.summary import CrossTrack, Heading, Headland, Truth
from fieldnav.messages import Direction, Floats
from fieldnav.simulation.plan import FieldPlan
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
    nearest, (s, offset, along) = nearest_lane(plan, xy)
    first, last = (_mean_ends_m(plan, ends_m)[nearest] for ends_m in (plan.s_first_m, plan.s_last_m))
    turned = heading - along
    turned = np.arctan2(np.sin(turned), np.cos(turned))
    inside = (s >= first) & (s <= last)
    believed = np.array(path.lanes)[keep]
    return Driven(nearest[inside], believed[inside], s[inside], offset[inside], turned[inside])


def nearest_lane(plan: FieldPlan, xy: Floats) -> tuple[NDArray[np.int64], tuple[Floats, Floats, Floats]]:
    """The lane that is nearest to each place (n, 2), and what FieldPlan.in_lane says of it there.

    Lane by lane: an hour's places in all of forty lanes at once are 300 MB.
    """
    lane = np.full(len(xy), plan.sown_lanes[0])
    s, offset, along = (np.array(values) for values in plan.in_lane(plan.sown_lanes[0], xy))
    for other in plan.sown_lanes[1:]:
        there = plan.in_lane(other, xy)
        closer = np.abs(there[1]) < np.abs(offset)
        lane[closer] = other
        for kept, values in zip((s, offset, along), there, strict=True):
            kept[closer] = values[closer]
    return lane, (s, offset, along)


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
        places = {lane: plan.in_lane(lane, at) for lane in plan.sown_lanes}
        lane = min(places, key=lambda each: abs(float(places[each][1])))
        camera_m = world.robot.cameras.get(direction.trailing).distance_m
        s, (first_m, last_m) = float(places[lane][0]), plan.lane_span_m(lane)
        used.append((s - last_m if direction is Direction.FORWARD else first_m - s) - camera_m)
    if not used:
        return Headland()
    return Headland(mean=_rounded(np.mean(used)), max=_rounded(np.max(used)))


def _coverage(world: World, run: Driven, lanes: int) -> tuple[int, int]:
    """How many of the lanes to be driven were missed, and how many of all were driven more than once."""
    missed = repeated = 0
    plan = world.plan
    length_m = _mean_ends_m(plan, plan.s_last_m) - _mean_ends_m(plan, plan.s_first_m)
    for lane in plan.sown_lanes:
        here = run.lane == lane
        cells = float(length_m[lane]) / CELL_M
        shares = [
            len(np.unique(np.floor(run.s_m[here & (run.believed == number)] / CELL_M))) / cells
            for number in np.unique(run.believed)
        ]
        missed += lane in plan.sown_lanes[:lanes] and max(shares, default=0.0) < COVERED
        repeated += sum(share > HALF for share in shares) > 1
    return missed, repeated


def _mean_ends_m(plan: FieldPlan, ends_m: Floats) -> Floats:
    """Where each lane's rows begin or end on average, those that have plants, shape (lanes,)."""
    counted = np.where(plan.sown.any(axis=1, keepdims=True), plan.sown, True)
    return np.asarray((ends_m * counted).sum(axis=1) / counted.sum(axis=1))


def _rounded(value: "float | np.floating[Any]") -> float | None:
    """Three decimals are below what any of these figures can bear."""
    return round(float(value), 3) if np.isfinite(value) else None
