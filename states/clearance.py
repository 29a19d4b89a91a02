"""No wheel on the crop while moving sideways: the robot draws away from rows that reach further out.

The wheels run between the robot's centre and the trailing camera; what they may touch lies nearer than that
camera sees. So the rows' ends are kept a margin beyond it.
"""

from fieldnav.messages import Bound, Direction, Evidence
from fieldnav.perception.sidestep.passing_rows import Crossing
from fieldnav.pinhole import Pinhole
from states.behaviour import Observation, Task
from states.memory import SwitchMemory
from states.names import Event

REACH_M = 1.0
"""To either side: beyond the wheels and their way of the next second."""
AWAY_GAIN_PER_S = 1.5
MOST_AWAY_MPS = 0.15
SIDEWAYS_FROM_M = 0.1
"""With crop nearer than the margin by this the robot only draws away, and does not move sideways."""
FARTHER_M = 0.05
MOST_TOWARDS_MPS = 0.05
"""Each centimetre nearer shows more of the rows, and rows that begin later than the others."""
NO_CROP = float("inf")


def nearest_end_m(rows: Crossing, camera: Pinhole) -> float:
    """How far beyond the trailing camera the nearest row's end stands; infinite when none is near."""
    ends = [row.end_m for row in rows.rows if abs(row.across_m) < REACH_M]
    return min(ends, default=NO_CROP) - camera.forward_m


def kept_off(task: Task, direction: Direction, end_m: float) -> tuple[float, float]:
    """As `away`; towards the crop, slowly, while it is further off than the exit should have left it."""
    beyond_m = end_m - task.crop.switching.headland_m
    if end_m == NO_CROP or beyond_m <= FARTHER_M:
        return away(task, direction, end_m)
    return -direction.sign * min(MOST_TOWARDS_MPS, AWAY_GAIN_PER_S * beyond_m), 1.0


def away(task: Task, direction: Direction, end_m: float) -> tuple[float, float]:
    """Speed along the robot's x that draws away from crop nearer than the margin, and the share of the
    sideways speed that may be had meanwhile."""
    short_m = task.crop.switching.crop_clearance_m - end_m
    if short_m <= 0:
        return 0.0, 1.0
    speed_mps = min(MOST_AWAY_MPS, AWAY_GAIN_PER_S * short_m)
    return direction.sign * speed_mps, max(0.0, 1.0 - short_m / SIDEWAYS_FROM_M)


def retreated(task: Task, switch: SwitchMemory, seen: Observation, direction: Direction) -> Evidence:
    """How far the robot has drawn away from the rows since the sidestep began; too far is a failure."""
    ahead_m = direction.sign * (seen.forward_m - switch.started_forward_m)
    limit_m = task.crop.switching.longest_retreat_m
    return Evidence("drawn away from the rows", ahead_m, limit_m, "m", Event.FAIL, Bound.ABOVE, alone=True)
