"""Sidestep.Crossing: move sideways until the next lane is found among the rows that pass (paper III-C)."""

from math import degrees

from fieldnav.messages import CameraName, Direction, Evidence, Frame
from fieldnav.perception.sidestep.next_lane import NextLane
from fieldnav.perception.sidestep.passing_rows import Crossing
from states.behaviour import Observation, Step, Task
from states.clearance import kept_off, nearest_end_m, retreated
from states.memory import LaneMemory, SwitchMemory
from states.names import Event
from states.passing import LIKELY, expected, found, lane_evidence, look
from states.recognising import Recognising
from states.sideways import sideways, too_far, way

REFRESH_FRAMES = 3
"""Seen 3 cm further on a row is still like itself, 12 cm on no longer surely."""
WORTH_A_LOOK = 0.5
"""And from which on a lane that shows fewer rows than the profile says is looked at from near."""
OVER_LANE_M = 0.05
"""When the robot stands over it: it may be a row that begins later, and comes into view from near."""


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
        moved = way(self._task, switch, seen)
        drawn = retreated(self._task, switch, seen, self._direction)
        reason = self._past_its_bounds(moved, drawn, switch)
        if reason:
            still = sideways(self._task, 0.0)
            return Step(still, Event.FAIL, (moved, drawn, *self._last), reason=reason)
        if frame is None:
            return self._step.continued()
        self._step = self._judged(frame, seen, switch, (moved, drawn))
        return self._step

    def _judged(
        self, frame: Frame, seen: Observation, switch: SwitchMemory, bounds: tuple[Evidence, ...]
    ) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        rows, sight = look(self._task, switch, frame, seen)
        rows, words = self._recognising.compare(frame, rows, switch, camera)
        switch.crossing = rows
        there = found(self._task, self._lane, rows)
        self._last = lane_evidence(self._task, self._lane, there)
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
        event, reason = self._decision(there, rows)
        if event is Event.FAIL:
            motion = sideways(self._task, 0.0)
        return Step(motion, event, evidence, sight, reason)

    def _decision(self, there: NextLane | None, rows: Crossing) -> tuple[Event | None, str]:
        if there is None or not self._believed(there, rows):
            return None, ""
        if expected(self._task, self._lane).here(there.pitch_m, self._task.crop):
            return Event.ROWS_CROSSED, ""
        if there.probability < LIKELY:
            return None, ""
        return Event.FAIL, f"a lane was seen {there.pitch_m:.2f} m from the old one, where none was expected"

    def _believed(self, there: NextLane, rows: Crossing) -> bool:
        """Whether the lane's place is likely and all of it was seen; with a row missing, whether to look."""
        wanted = self._task.crop.rows.per_lane
        if 2 * there.rows_seen < wanted or there.outermost_m > rows.viewed_m:
            return False
        if there.rows_seen == wanted:
            return there.probability >= LIKELY
        return there.probability >= WORTH_A_LOOK and there.middle_m < OVER_LANE_M

    def _past_its_bounds(self, moved: Evidence, drawn: Evidence, switch: SwitchMemory) -> str:
        if too_far(moved):
            return self._not_found(switch)
        return "crop of the next lane stands in the wheels' way" if too_far(drawn) else ""

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
