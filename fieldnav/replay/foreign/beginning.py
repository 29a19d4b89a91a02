"""How a mission sets off in a recording: without the checks of a robot, and again after a stop."""

from fieldnav.messages import Direction
from fieldnav.mission.loop import NOTHING_SENT, Mission
from fieldnav.mission.operating import Operating
from states.behaviour import Step
from states.machine import Change
from states.memory import LaneMemory
from states.names import Event, Follow, Phase

UNCHECKED = "a recording is driven without the checks of a robot"
ANEW = "begun anew, as asked for, in what follows of the recording"
BEHIND = "begun anew behind the step in the stamps"


def begin(mission: Mission, operating: Operating, now_s: float, direction: Direction) -> None:
    """Start, and go on to where the lane's rows are looked for, whatever the checks would say.

    A recording may have one camera, and may be of a robot that drives backward.
    """
    operating.start(now_s)
    course = mission.course
    change = Change(course.leaf, Event.READY, (direction, Phase.FOLLOW, Follow.ACQUIRING))
    step = Step(event=Event.READY, reason=UNCHECKED)
    course.chronicle.changed(now_s, change, step)
    course.brought(now_s, change)
    course.chronicle.tell(now_s, course.leaf, change, step, NOTHING_SENT)


def begin_anew(
    mission: Mission, operating: Operating, now_s: float, direction: Direction, reason: str
) -> None:
    """After a stop: forget the lane and look for one, as if a person had set the robot going again."""
    course = mission.course
    course.go(now_s, Step(event=Event.RESET, reason=reason))
    course.behaviours.lane = LaneMemory(number=1)
    begin(mission, operating, now_s, direction)
