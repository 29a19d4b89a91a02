"""The names of states and events.

A state is a path of enum members from the outermost state to the leaf, such as Forward, Follow, Tracking.
"""

from enum import Enum

from fieldnav.messages import Direction


class Top(Enum):
    """The states outside the lanes."""

    IDLE = "Idle"
    CHECKING = "Checking"
    RESUMING = "Resuming"
    PAUSED = "Paused"
    FAULT = "Fault"
    FINISHED = "Finished"


class Phase(Enum):
    """What is done in a lane, in either direction of travel (the paper's phases 1 and 4, 2, 3)."""

    FOLLOW = "Follow"
    EXIT = "Exit"
    SIDESTEP = "Sidestep"


class Follow(Enum):
    ACQUIRING = "Acquiring"
    TRACKING = "Tracking"
    COASTING = "Coasting"


class Sidestep(Enum):
    ORIENTING = "Orienting"
    SAMPLING = "Sampling"
    CROSSING = "Crossing"
    SETTLING = "Settling"
    VERIFYING = "Verifying"
    RETURNING = "Returning"
    ENTERING = "Entering"


class Fault(Enum):
    """A recoverable fault may be resumed; a latched one needs an explicit reset."""

    RECOVERABLE = "Recoverable"
    LATCHED = "Latched"


Path = tuple[Enum, ...]


class Event(Enum):
    """What makes the machine change its state. Behaviours propose, only the machine fires."""

    START = "start"
    READY = "ready"
    ROWS_FOUND = "rows found"
    ROWS_LOST = "rows lost"
    ROWS_SEEN_AGAIN = "rows seen again"
    LANE_ENDED = "lane ended"
    LANE_LEFT = "lane left"
    LAST_LANE_LEFT = "last lane left"
    WHEELS_TURNED = "wheels turned"
    ROW_SAMPLED = "row sampled"
    ROWS_CROSSED = "rows crossed"
    LANE_REACHED = "lane reached"
    LANE_OFF_CENTRE = "lane off centre"
    LANE_REFUSED = "lane refused"
    OLD_LANE_SEEN = "old lane seen"
    LANE_VERIFIED = "lane verified"
    LANE_CENTRED = "lane centred"
    PAUSE = "pause"
    RESUME = "resume"
    PLACE_FITS = "place fits"
    FAIL = "fail"
    LATCH = "latch"
    RESET = "reset"


def text(path: Path) -> str:
    """How a state is written in the journal: Forward.Follow.Tracking."""
    return ".".join(str(member.value) for member in path)


def direction_of(path: Path) -> Direction | None:
    """The direction of travel that a lane state belongs to."""
    return path[0] if isinstance(path[0], Direction) else None
