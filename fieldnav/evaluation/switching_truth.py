"""How lane switches truly went, from the true path: whether, how far, and how the new lane was entered."""

from dataclasses import dataclass
from math import pi

import numpy as np

from fieldnav.evaluation.path import TruePath
from fieldnav.evaluation.switching_track import SwitchTrack, track
from fieldnav.messages import Direction, Floats
from fieldnav.settings.robot import Robot
from fieldnav.simulation.plan import FieldPlan
from states.names import Path as StatePath
from states.names import Phase, Sidestep, direction_of

ENTRY_M = 1.0
"""Beyond its end a lane goes on straight, as its first metre runs: what a robot there can know of it."""
HALF = 0.5


@dataclass(frozen=True, slots=True)
class Switch:
    """One lane switch; what did not come to pass is NaN.

    lane: number of the lane that was left, as driven; headland_m: end of the crop to the trailing camera as
    the robot begins to move sideways; entry_offset_m, entry_angle_rad: true distance from the next lane's
    centre line, positive to the robot's left, and angle to it as following starts.
    """

    lane: int
    direction: Direction
    succeeded: bool
    headland_m: float
    entry_offset_m: float
    entry_angle_rad: float
    duration_s: float
    sideways_m: float
    fault: str
    track: SwitchTrack


def switches_of(plan: FieldPlan, robot: Robot, spacing_m: float, path: TruePath) -> list[Switch]:
    """Every switch that was begun, in order; `spacing_m` is that of the crop's rows."""
    aside = np.array([Phase.SIDESTEP in state for state in path.states], dtype=np.int8)
    changes = np.diff(aside, prepend=0, append=0)
    spans = zip(np.flatnonzero(changes == 1), np.flatnonzero(changes == -1), strict=True)
    return [_switch(plan, robot, spacing_m, path, int(start), int(end)) for start, end in spans]


def _switch(plan: FieldPlan, robot: Robot, spacing_m: float, path: TruePath, start: int, end: int) -> Switch:
    """The switch whose sidestep lasts from tick `start` up to, without, tick `end`."""
    xy = path.xy()
    direction = direction_of(path.states[start])
    assert direction is not None, "every sidestep belongs to a direction of travel"
    left = _nearest_lane(plan, xy[start])
    offset_m, angle_rad, fault = _entry(plan, spacing_m, left, path, start, end)
    moving = next((i for i in range(start, end) if path.states[i][-1] is not Sidestep.ORIENTING), start)
    last = min(end, len(xy) - 1)
    return Switch(
        lane=path.lanes[max(start - 1, 0)],
        direction=direction,
        succeeded=not fault,
        headland_m=headland_m(plan, robot, left, direction, xy[moving]),
        entry_offset_m=offset_m,
        entry_angle_rad=angle_rad,
        duration_s=path.stamp_s[last] - path.stamp_s[start],
        sideways_m=_sideways_m(xy[start : last + 1], np.array(path.heading_rad[start : last + 1])),
        fault=fault,
        track=track(plan, left, direction, path, start, end),
    )


def _entry(
    plan: FieldPlan, spacing_m: float, left: int, path: TruePath, start: int, end: int
) -> tuple[float, float, str]:
    """(offset, angle, fault) as following starts: how the lane next to the one that was left is entered."""
    direction, unknown = direction_of(path.states[start]), (float("nan"), float("nan"))
    if direction is None or end >= len(path.states) or not _follows(path.states[end], direction):
        return *unknown, "following never started"
    if left + 1 >= plan.lanes:
        return *unknown, "there is no further lane"
    at = np.array([path.x_m[end], path.y_m[end]])
    offset_m, angle_rad = against(plan, left + 1, direction, at, path.heading_rad[end])
    if abs(offset_m) < HALF * spacing_m:
        return offset_m, angle_rad, ""
    return offset_m, angle_rad, f"following starts {abs(offset_m):.2f} m from the next lane's centre line"


def against(
    plan: FieldPlan, lane: int, direction: Direction, xy: Floats, heading_rad: float
) -> tuple[float, float]:
    """Offset, m, to the left of a lane's centre line and angle to it, rad, of a robot that is about to enter.

    `direction` is that of travel in the lane that was left. Beyond its end a lane goes on straight.
    """
    if direction is Direction.FORWARD:
        end_m, inward = float(plan.s_last_m[lane].mean()), -1
    else:
        end_m, inward = float(plan.s_first_m[lane].mean()), 1
    s, offset, along = plan.in_lane(lane, xy)
    if (float(s) - end_m) * inward < 0:
        at_m = np.array([end_m, end_m + inward * ENTRY_M])
        near, far = plan.centreline.position(at_m, plan.rows.lane_n(lane, at_m))
        way = (far - near) * inward / np.hypot(*(far - near))
        away = xy - near
        offset, along = way[0] * away[1] - way[1] * away[0], np.arctan2(way[1], way[0])
    turned = (heading_rad - float(along) + pi) % (2 * pi) - pi
    return float(offset), float(turned)


def headland_m(plan: FieldPlan, robot: Robot, lane: int, direction: Direction, xy: Floats) -> float:
    """Empty space used: from the end of the lane's longest row to the trailing camera."""
    camera_m = robot.cameras.get(direction.trailing).distance_m
    s = float(plan.in_lane(lane, xy)[0])
    if direction is Direction.FORWARD:
        return s - camera_m - float(plan.s_last_m[lane].max())
    return float(plan.s_first_m[lane].min()) - s - camera_m


def _nearest_lane(plan: FieldPlan, xy: Floats) -> int:
    return int(np.argmin([abs(float(plan.in_lane(lane, xy)[1])) for lane in range(plan.lanes)]))


def _follows(state: StatePath, left: Direction) -> bool:
    return Phase.FOLLOW in state and direction_of(state) is left.opposite


def _sideways_m(xy: Floats, heading_rad: Floats) -> float:
    """Length of the way that led across the robot's own axis."""
    step = np.diff(xy, axis=0)
    return float(np.abs(np.cos(heading_rad[1:]) * step[:, 1] - np.sin(heading_rad[1:]) * step[:, 0]).sum())
