"""What the names of states tell, as they stand in files: Forward.Follow.Tracking."""

from fieldnav.inquiry.stops import top
from fieldnav.messages import Direction
from states.names import Event, Fault, Follow, Phase, Top

LEFT = frozenset({Event.LANE_LEFT.value, Event.LAST_LANE_LEFT.value})
CENTRED = Event.LANE_CENTRED.value
LOST = Event.ROWS_LOST.value
TRAVEL = {each.value: each for each in Direction}


def is_fault(state: str) -> bool:
    return top(state) == Top.FAULT.value


def is_latched(state: str) -> bool:
    return state.endswith(f".{Fault.LATCHED.value}")


def in_phase(state: str, phase: Phase) -> bool:
    """Whether it is one of a phase's states, in either direction."""
    return phase.value in state.split(".")


def follows_rows(state: str) -> bool:
    """Whether the robot drives by the rows it sees, and its error means something."""
    return in_phase(state, Phase.FOLLOW) and not state.endswith(Follow.ACQUIRING.value)


def direction_of(state: str) -> Direction | None:
    """The direction of travel that a lane's state begins with; None outside the lanes."""
    return TRAVEL.get(top(state))
