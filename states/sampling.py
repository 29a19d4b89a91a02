"""Sidestep.Sampling: at standstill, take the features of the outermost row (paper III-C)."""

from fieldnav.messages import Bound, CameraName, Direction, Evidence, Frame, RowLine
from fieldnav.perception.perceive import find
from fieldnav.perception.recognition import describe
from fieldnav.perception.sidestep.passing_rows import begin
from fieldnav.settings.crop import ControlLaw
from states.behaviour import Observation, Sight, Step, Task
from states.judgement import first_of
from states.memory import LaneMemory
from states.names import Event
from states.sideways import sideways

LOOKED_FRAMES = 4
"""At rest, before the rows are followed: the first picture may still show the robot's stopping."""
LONGEST_S = 3.0
"""Without any row in that time there is none to count from."""
HEADING_SD = {ControlLaw.PATH_FOLLOWING: 0.015, ControlLaw.PAPER: 0.05}
"""Standard deviation of the rows' slope: remembered over metres, or from the few plants at a row's end."""


class Sampling:
    """Takes over the rows of the lane that was left and describes the one nearest the next lane."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._entered_s: float | None = None
        self._looked = 0
        self._hold = sideways(task, task.crop.speeds.sidestep_mps, hold=True)
        self._step = Step(self._hold)

    def step(self, seen: Observation) -> Step:
        if self._entered_s is None:
            self._entered_s = seen.now_s
        frame = seen.frames.get(self._direction.trailing)
        if frame is None:
            return self._step.continued()
        self._looked += 1
        rows = self._rows(frame, seen)
        looked_s = seen.now_s - self._entered_s
        evidence = (
            Evidence("rows to count from", len(rows), 1, "rows", Event.ROW_SAMPLED),
            Evidence("frames looked at", self._looked, LOOKED_FRAMES, "frames", Event.ROW_SAMPLED),
            Evidence("looked for the rows", looked_s, LONGEST_S, "s", Event.FAIL, Bound.ABOVE),
        )
        event = first_of(evidence, Event.ROW_SAMPLED, Event.FAIL)
        if event is Event.ROW_SAMPLED:
            return self._sampled(frame, seen, rows, evidence)
        if event is Event.FAIL:
            return Step(self._hold, event, evidence, Sight(frame), "no row to count from")
        self._step = Step(self._hold, None, evidence, Sight(frame, rows))
        return self._step

    def _sampled(
        self, frame: Frame, seen: Observation, rows: tuple[RowLine, ...], evidence: tuple[Evidence, ...]
    ) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        switch = self._lane.switching
        outward = self._task.outward(frame.camera)
        outermost = rows[0] if outward > 0 else rows[-1]
        switch.reference = describe(frame.image, outermost, crop, camera, 0.0, camera.ground_middle_px)
        switch.crossing = begin(rows, HEADING_SD[crop.control.law], outward, crop, camera)
        switch.exposed = seen.exposed_at(frame)
        evidence = (
            *evidence,
            Evidence("features of the outermost row", len(switch.reference), None, "features"),
        )
        return Step(self._hold, Event.ROW_SAMPLED, evidence, Sight(frame, rows))

    def _rows(self, frame: Frame, seen: Observation) -> tuple[RowLine, ...]:
        """The lane's rows as the guide knows them; found afresh where it does not."""
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        if self._lane.under_way:
            known = self._lane.guide.rows(frame.camera, seen.exposed_at(frame))
            if known:
                return known
        lane = find(frame.image, crop, camera).lane
        return lane.rows if lane else ()
