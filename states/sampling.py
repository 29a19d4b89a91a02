"""Sidestep.Sampling: at standstill, take the features of the outermost row (paper III-C)."""

from fieldnav.messages import CameraName, Direction, Evidence, Frame
from fieldnav.perception.passing_rows import begin
from fieldnav.perception.perceive import View, find
from fieldnav.perception.recognition import describe
from states.agreement import Agreement
from states.behaviour import Observation, Sight, Step, Task
from states.memory import LaneMemory
from states.names import Event
from states.sideways import sideways

AGREEING_FRAMES = 3
LONGEST_S = 3.0
"""After this the rows that the exit followed are taken as they were last seen."""


class Sampling:
    """Finds the lane once more behind the robot and describes the row nearest the next lane."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._agreement = Agreement(AGREEING_FRAMES)
        self._entered_s: float | None = None
        self._hold = sideways(task, task.crop.speeds.sidestep_mps, hold=True)
        self._step = Step(self._hold)

    def step(self, seen: Observation) -> Step:
        if self._entered_s is None:
            self._entered_s = seen.now_s
        frame = seen.frames.get(self._direction.trailing)
        if frame is None:
            return self._step.continued()
        found = find(frame.image, self._task.crop, self._task.cameras[frame.camera])
        agreed = self._agreement.add(found.lane)
        looked_s = seen.now_s - self._entered_s
        evidence = (*self._agreement.evidence(), Evidence("looked for the rows", looked_s, LONGEST_S, "s"))
        if (agreed and found.lane) or looked_s > LONGEST_S:
            return self._sampled(frame, found, evidence)
        self._step = Step(self._hold, None, evidence, Sight(frame, found.lines, found.centres))
        return self._step

    def _sampled(self, frame: Frame, found: View, evidence: tuple[Evidence, ...]) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        held = self._lane.trailing.rows if self._lane.trailing else ()
        rows = found.lane.rows if found.lane else held
        switch = self._lane.switch
        assert switch, "Orienting begins the switch"
        if not rows:
            return Step(
                self._hold, Event.FAIL, evidence, Sight(frame, (), found.centres), "no row to count from"
            )
        outward = self._task.outward(frame.camera)
        outermost = rows[0] if outward > 0 else rows[-1]
        switch.reference = describe(frame.image, outermost, crop, camera, 0.0, camera.centre_y_px)
        switch.crossing = begin(tuple(rows), outward, crop, camera)
        evidence = (
            *evidence,
            Evidence("features of the outermost row", len(switch.reference), None, "features"),
        )
        return Step(self._hold, Event.ROW_SAMPLED, evidence, Sight(frame, tuple(rows), found.centres))
