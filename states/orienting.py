"""Sidestep.Orienting: stop, then turn the wheels across before the robot moves (paper III-C)."""

from fieldnav.messages import CameraName, Direction, Evidence, Motion
from states.behaviour import Observation, Step, Task
from states.memory import LaneMemory, SwitchMemory
from states.names import Event
from states.sideways import sideways

SETTLED_TICKS = 2
LONGEST_S = 15.0
"""Stopping and a quarter turn of the slowest wheel take a few seconds."""


class Orienting:
    """Waits at standstill until all wheels stand across."""

    cameras: tuple[CameraName, ...] = ()

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self._task, self._lane = task, lane
        self._entered_s: float | None = None
        self._turning_ticks = 0

    def step(self, seen: Observation) -> Step:
        if self._entered_s is None:
            self._entered_s = seen.now_s
        taken_s = seen.now_s - self._entered_s
        evidence = (Evidence("turning the wheels takes", taken_s, LONGEST_S, "s"),)
        if taken_s > LONGEST_S:
            return Step(Motion(), Event.FAIL, evidence, reason="the wheels do not turn across")
        if not seen.stopped and not self._turning_ticks:
            return Step(Motion(), None, evidence)
        self._turning_ticks += 1
        motion = sideways(self._task, self._task.crop.speeds.sidestep_mps, hold=True)
        # The word on alignment belongs to the motion commanded before, so the first tick says nothing.
        if seen.wheels_aligned and self._turning_ticks > SETTLED_TICKS:
            self._lane.switch = SwitchMemory(seen.sideways_m, seen.forward_m)
            return Step(motion, Event.WHEELS_TURNED, evidence)
        return Step(motion, None, evidence)
