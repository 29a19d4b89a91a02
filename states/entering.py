"""Sidestep.Entering: slowly into the verified lane, straightening, until its heading is known well."""

from fieldnav.messages import Bound, CameraName, Direction, Evidence, Frame
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.sidestep.lane_entry import Entry, entry
from fieldnav.perception.sidestep.next_lane import NextLane
from fieldnav.perception.sidestep.passing_rows import Crossing, look_at_m
from states.behaviour import Observation, Step, Task
from states.judgement import first_of, holds
from states.memory import LaneMemory
from states.names import Event
from states.passing import found, lane_evidence, look
from states.settling import entry_evidence, furthest_off, towards
from states.sideways import sideways

SURE_DEG = 0.6
"""Standard deviation of the heading: at a robot's centre 1.4 m from the rows it makes 1.5 cm."""
LONGEST_M = 1.0
"""About the length of the view: by then as many plants again have been seen as at its end."""
LOST_FRAMES = 15
LEFT_OFF = 2.0
"""Of what counts as centred: what is left at the end of the way may be so much more."""


class Entering:
    """Drives in by the rows that passed; the few plants at their ends do not tell their direction."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._from_m: float | None = None
        self._lost = 0
        self._step = Step(sideways(task, 0.0))

    def step(self, seen: Observation) -> Step:
        if self._from_m is None:
            self._from_m = seen.forward_m
        frame = seen.frames.get(self._direction.trailing)
        switch = self._lane.switching
        if frame is None:
            return self._step.continued()
        rows, sight = look(self._task, switch, frame, seen)
        there = found(self._task, self._lane, rows)
        self._lost = 0 if there else self._lost + 1
        lost = self._lost
        evidence = (
            *lane_evidence(self._task, self._lane, there),
            Evidence(
                "frames without the lane", lost, LOST_FRAMES, "frames", Event.FAIL, Bound.ABOVE, alone=True
            ),
        )
        if there is None:
            event = first_of(evidence, Event.FAIL)
            reason = "the lane is lost while it is entered" if event else ""
            self._step = Step(sideways(self._task, 0.0), event, evidence, sight, reason)
            return self._step
        at = self._entry(rows, there, frame)
        evidence = (*evidence, *self._entered(at, abs(seen.forward_m - self._from_m)))
        event = first_of(evidence, Event.LANE_CENTRED, Event.FAIL)
        reason = "the new lane could not be entered straight" if event is Event.FAIL else ""
        speed_mps = 0.0 if event else self._task.crop.speeds.acquire_mps
        motion = towards(self._task, self._direction, at, speed_mps)
        self._step = Step(motion, event, evidence, sight, reason)
        return self._step

    def _entered(self, at: Entry, driven_m: float) -> tuple[Evidence, ...]:
        """Centred once sure of it; at the end of the way what is left must at least not be much."""
        driven = Evidence("driven in", driven_m, LONGEST_M, "m", Event.FAIL, Bound.ABOVE)
        share, sure_deg = (LEFT_OFF, None) if holds(driven) else (1.0, SURE_DEG)
        off = furthest_off(at, self._task)
        return (
            driven,
            *entry_evidence(at, self._task, Event.LANE_CENTRED, share, sure_deg),
            Evidence("furthest off, over what counts as centred", off, LEFT_OFF, "", Event.FAIL, Bound.ABOVE),
        )

    def _entry(self, rows: Crossing, there: NextLane, frame: Frame) -> Entry:
        plane = canopy_plane(self._task.cameras[frame.camera], self._task.crop)
        return entry(rows, there, look_at_m(plane))
