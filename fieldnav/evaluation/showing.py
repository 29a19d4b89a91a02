"""The orders in which a recorded sequence is shown, as if the robot stopped, backed up or lost frames."""

from enum import Enum

STOP = 15  # frames that a robot stands for, one second
DROPPED = 3  # one frame in so many is left


class Showing(Enum):
    """What the robot does while a sequence is shown."""

    FORWARDS = "forwards"
    BACKWARDS = "backwards"
    STOP = "with a stop"
    BACK_UP = "backing up"
    DROPPED = "two of three frames dropped"


def order_of(showing: Showing, count: int) -> list[int]:
    """Which of so many frames are shown, one after the other."""
    forwards, third = list(range(count)), count // 3
    match showing:
        case Showing.FORWARDS:
            return forwards
        case Showing.BACKWARDS:
            return forwards[::-1]
        case Showing.STOP:
            return forwards[:third] + [third] * STOP + forwards[third:]
        case Showing.BACK_UP:
            return forwards[: 2 * third] + forwards[third : 2 * third][::-1] + forwards[third:]
        case Showing.DROPPED:
            return forwards[::DROPPED]
