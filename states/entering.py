"""Sidestep.Entering: slowly into the verified lane, straightening, until its heading is known well."""

from math import degrees

from fieldnav.messages import CameraName, Direction, Evidence, Frame
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.sidestep.lane_entry import Entry, entry
from fieldnav.perception.sidestep.next_lane import NextLane
from fieldnav.perception.sidestep.passing_rows import Crossing, look_at_m
from states.behaviour import Observation, Step, Task
from states.memory import LaneMemory
from states.names import Event
from states.passing import found, lane_evidence, look
from states.settling import entry_evidence, towards, within
from states.sideways import sideways, too_far

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
        driven = Evidence("driven in", abs(seen.forward_m - self._from_m), LONGEST_M, "m")
        evidence = (*lane_evidence(self._task, self._lane, there), driven)
        self._lost = 0 if there else self._lost + 1
        if there is None:
            gone = self._lost > LOST_FRAMES
            reason = "the lane is lost while it is entered" if gone else ""
            event = Event.FAIL if gone else None
            self._step = Step(sideways(self._task, 0.0), event, evidence, sight, reason)
            return self._step
        at = self._entry(rows, there, frame)
        evidence = (*evidence, *entry_evidence(at, self._task))
        event, reason = self._decision(at, driven)
        speed_mps = 0.0 if event else self._task.crop.speeds.acquire_mps
        motion = towards(self._task, self._direction, at, speed_mps)
        self._step = Step(motion, event, evidence, sight, reason)
        return self._step

    def _decision(self, at: Entry, driven: Evidence) -> tuple[Event | None, str]:
        """Centred once sure of it; at the end of the way what is left must at least not be much."""
        if within(at, self._task) and degrees(at.slope_sd) <= SURE_DEG:
            return Event.LANE_CENTRED, ""
        if not too_far(driven):
            return None, ""
        if within(at, self._task, LEFT_OFF):
            return Event.LANE_CENTRED, ""
        return Event.FAIL, "the new lane could not be entered straight"

    def _entry(self, rows: Crossing, there: NextLane, frame: Frame) -> Entry:
        plane = canopy_plane(self._task.cameras[frame.camera], self._task.crop)
        return entry(rows, there, look_at_m(plane))
