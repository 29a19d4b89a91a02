"""Moving sideways to the next lane: heading, distance to the crop kept meanwhile, the bound on the way."""

from fieldnav.messages import Bound, Evidence, Motion, Steering, Twist
from states.behaviour import Observation, Task
from states.memory import SwitchMemory
from states.names import Event

HEADING_GAIN_PER_S = 0.5
"""Turns an error of heading out within two seconds, slower than the heading is known. Our choice."""
MOST_TURN_RPS = 0.05
"""Three degrees a second: the wheels stay nearly across. Our choice."""


def sideways(
    task: Task, outward_mps: float, slope: float = 0.0, ahead_mps: float = 0.0, hold: bool = False
) -> Motion:
    """Motion to the next lane's side that turns the robot straight to rows of that slope on the ground.

    ahead_mps: along the robot's own x; hold: the wheels only turn into place.
    """
    turn_rps = max(-MOST_TURN_RPS, min(MOST_TURN_RPS, HEADING_GAIN_PER_S * slope))
    return Motion(Twist(ahead_mps, task.side.sign * outward_mps, turn_rps), Steering.OMNIDIRECTIONAL, hold)


def way(task: Task, switch: SwitchMemory, seen: Observation, beyond: Event | None = None) -> Evidence:
    """How far this sidestep has gone to the next lane's side, against how far it may go.

    beyond: the event that comes about when it has gone further.
    """
    limit_m = task.crop.switching.longest_sidestep_m
    moved_m = task.side.sign * (seen.sideways_m - switch.started_m)
    return Evidence("moved sideways", moved_m, limit_m, "m", beyond, Bound.ABOVE, alone=True)


def began_m(task: Task, seen: Observation, old_m: float) -> float:
    """The wheels' sideways travel over the middle of the old lane, which lies old_m outward of the robot."""
    return seen.sideways_m + task.side.sign * old_m
