"""Sidestep.Orienting: stop, then turn the wheels across before the robot moves (paper III-C)."""

from fieldnav.messages import Bound, CameraName, Direction, Evidence, Motion
from states.behaviour import Observation, Step, Task
from states.judgement import first_of
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
        self._turning_ticks += seen.stopped or self._turning_ticks > 0
        evidence = self._evidence(seen, seen.now_s - self._entered_s)
        event = first_of(evidence, Event.FAIL, Event.WHEELS_TURNED)
        if event is Event.FAIL:
            return Step(Motion(), event, evidence, reason="the wheels do not turn across")
        if not self._turning_ticks:
            return Step(Motion(), None, evidence)
        if event is Event.WHEELS_TURNED:
            self._lane.switch = SwitchMemory(seen.sideways_m, seen.forward_m)
        return Step(sideways(self._task, self._task.crop.speeds.sidestep_mps, hold=True), event, evidence)

    def _evidence(self, seen: Observation, taken_s: float) -> tuple[Evidence, ...]:
        turned, ticks = Event.WHEELS_TURNED, self._turning_ticks
        return (
            Evidence("turning the wheels takes", taken_s, LONGEST_S, "s", Event.FAIL, Bound.ABOVE),
            Evidence("robot stands", float(seen.stopped)),
            # The word on alignment belongs to the motion commanded before, so the first tick says nothing.
            Evidence("ticks of turning", ticks, SETTLED_TICKS, "ticks", turned, Bound.ABOVE),
            Evidence("wheels stand across", float(seen.wheels_aligned), 1, "", turned),
        )
