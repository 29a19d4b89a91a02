"""Sidestep.Crossing: move sideways until the next lane is found among the rows that pass (paper III-C)."""

from math import degrees

from fieldnav.messages import CameraName, Direction, Evidence, Frame
from states.behaviour import Observation, Step, Task
from states.clearance import kept_off, nearest_end_m, retreated
from states.judgement import first_of, holds
from states.memory import LaneMemory, SwitchMemory
from states.names import Event
from states.passing import found, look
from states.recognising import Recognising
from states.sideways import sideways, way
from states.standing_out import standing_out

REFRESH_FRAMES = 3
"""Seen 3 cm further on a row is still like itself, 12 cm on no longer surely."""
IN_THE_WAY = "crop of the next lane stands in the wheels' way"


class CrossingRows:
    """Moves to the next lane's side, weighing what speaks for each row, until a lane stands out."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._recognising = Recognising(task.crop, REFRESH_FRAMES)
        self._last: tuple[Evidence, ...] = ()
        self._step = Step(sideways(task, task.crop.speeds.sidestep_mps))

    def step(self, seen: Observation) -> Step:
        frame = seen.frames.get(self._direction.trailing)
        switch = self._lane.switching
        moved = way(self._task, switch, seen, Event.FAIL)
        bounds = (moved, retreated(self._task, switch, seen, self._direction))
        if first_of(bounds, Event.FAIL):
            reason = self._not_found(switch) if holds(moved) else IN_THE_WAY
            return Step(sideways(self._task, 0.0), Event.FAIL, (*bounds, *self._last), reason=reason)
        if frame is None:
            return self._step.continued()
        self._step = self._judged(frame, seen, switch, bounds)
        return self._step

    def _judged(
        self, frame: Frame, seen: Observation, switch: SwitchMemory, bounds: tuple[Evidence, ...]
    ) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        rows, sight = look(self._task, switch, frame, seen)
        rows, words = self._recognising.compare(frame, rows, switch, camera)
        switch.crossing = rows
        there = found(self._task, self._lane, rows)
        self._last = standing_out(self._task, self._lane, there, rows)
        end_m = nearest_end_m(rows, camera)
        evidence = (
            *self._last,
            *words,
            Evidence("angle to the rows", degrees(rows.slope), None, "deg"),
            Evidence("crop beyond the trailing camera", end_m, crop.switching.crop_clearance_m, "m"),
            *bounds,
        )
        ahead_mps, share = kept_off(self._task, self._direction, end_m)
        motion = sideways(self._task, share * crop.speeds.sidestep_mps, rows.slope, ahead_mps)
        event = first_of(evidence, Event.ROWS_CROSSED, Event.FAIL)
        if event is not Event.FAIL or there is None:
            return Step(motion, event, evidence, sight)
        reason = f"a lane was seen {there.pitch_m:.2f} m from the old one, where none was expected"
        return Step(sideways(self._task, 0.0), event, evidence, sight, reason)

    def _not_found(self, switch: SwitchMemory) -> str:
        """Why the sidestep ends, and at which distances rows were seen."""
        reason = "the next lane was not found within the sidestep"
        if switch.pitch_m is not None and switch.rows_counted < self._task.crop.rows.per_lane:
            reason = "which of the next lane's rows is missing could not be told within the sidestep"
        rows = switch.crossing
        if rows is None or not rows.new:
            return f"{reason}: no row was seen"
        old_m = rows.rows[rows.outermost_old].across_m
        places = ", ".join(f"{rows.rows[index].across_m - old_m:.2f}" for index in rows.new)
        return f"{reason}: rows were seen {places} m from the last one"
