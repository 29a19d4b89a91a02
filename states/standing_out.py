"""Whether the next lane stands out among the rows that pass: likely in its place, and all of it seen."""

from fieldnav.messages import Bound, Evidence
from fieldnav.perception.sidestep.next_lane import NextLane
from fieldnav.perception.sidestep.passing_rows import Crossing
from states.behaviour import Task
from states.judgement import holds
from states.memory import LaneMemory
from states.names import Event
from states.passing import LIKELY, expected

WORTH_A_LOOK = 0.5
"""And from which on a lane that shows fewer rows than the profile says is looked at from near."""
OVER_LANE_M = 0.05
"""When the robot stands over it: it may be a row that begins later, and comes into view from near."""


def standing_out(
    task: Task, lane: LaneMemory, there: NextLane | None, rows: Crossing
) -> tuple[Evidence, ...]:
    """What is known of the next lane: reached where it may be, a failure where none was expected."""
    least = task.crop.rows.per_lane / 2
    if there is None:
        return (Evidence("rows of the next lane", 0, least, "rows", Event.ROWS_CROSSED),)
    believed = _believed(task, there, rows)
    return (*believed, *_where(task, lane, there, all(map(holds, believed))))


def _believed(task: Task, there: NextLane, rows: Crossing) -> tuple[Evidence, ...]:
    """Whether the lane's place is likely and all of it was seen; with a row missing, whether to look."""
    wanted, crossed, at_most = task.crop.rows.per_lane, Event.ROWS_CROSSED, Bound.AT_MOST
    whole, middle_m = there.rows_seen == wanted, there.middle_m
    likely = LIKELY if whole else WORTH_A_LOOK
    seen = (
        Evidence("rows of the next lane", there.rows_seen, wanted / 2, "rows", crossed),
        Evidence("probability of its place", there.probability, likely, "", crossed),
        Evidence("distance to its last row", there.outermost_m, rows.viewed_m, "m", crossed, at_most),
    )
    if whole:
        return seen
    return (*seen, Evidence("distance to its middle", middle_m, OVER_LANE_M, "m", crossed, Bound.BELOW))


def _where(task: Task, lane: LaneMemory, there: NextLane, believed: bool) -> tuple[Evidence, ...]:
    """Whether it stands where the next lane may be; further off it is another one, or none."""
    wanted, crossed, fails = expected(task, lane), Event.ROWS_CROSSED, Event.FAIL
    off_m, most_m = wanted.off_m(there.pitch_m, task.crop)
    return (
        Evidence("its distance from the old lane", there.pitch_m, wanted.pitch_m, "m"),
        Evidence("off where the next lane may be by", off_m, most_m, "m", crossed, Bound.AT_MOST),
        Evidence("some lane stands out", float(believed), 1, "", fails),
        Evidence("probability that it stands there", there.probability, LIKELY, "", fails),
        Evidence("too far off for the next lane by", off_m, most_m, "m", fails, Bound.ABOVE),
    )
