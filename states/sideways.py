"""Moving sideways towards the next lane: the motion, the heading kept meanwhile, the bound on the way."""

from fieldnav.messages import Evidence, Motion, Steering, Twist
from states.behaviour import Observation, Task
from states.memory import SwitchMemory

HEADING_GAIN_PER_S = 0.5
"""Turns an error of heading out within two seconds, slower than the heading is known. Our choice."""
MOST_TURN_RPS = 0.05
"""Three degrees a second: the wheels stay nearly across. Our choice."""


def sideways(task: Task, speed_mps: float, slope: float = 0.0, hold: bool = False) -> Motion:
    """Motion to the next lane's side that turns the robot straight to rows of that slope on the ground."""
    turn_rps = max(-MOST_TURN_RPS, min(MOST_TURN_RPS, HEADING_GAIN_PER_S * slope))
    return Motion(Twist(0.0, task.side.sign * speed_mps, turn_rps), Steering.OMNIDIRECTIONAL, hold)


def turned_rad(switch: SwitchMemory, stamp_s: float, motion: Motion) -> float:
    """By how much the robot was told to turn since the last frame; takes note of this one."""
    last_s, switch.seen_s = switch.seen_s, stamp_s
    return 0.0 if last_s is None else motion.twist.yaw_rate_rps * (stamp_s - last_s)


def way(task: Task, switch: SwitchMemory, seen: Observation) -> Evidence:
    """How far this sidestep has gone, against how far it may go."""
    limit_m = task.crop.switching.longest_sidestep_m
    return Evidence("moved sideways", abs(seen.sideways_m - switch.started_m), limit_m, "m")


def too_far(moved: Evidence) -> bool:
    """Whether the sidestep has passed its bound."""
    return moved.threshold is not None and moved.value > moved.threshold
