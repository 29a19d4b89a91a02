"""Follow.Coasting: rows lost for a moment; on along the lane, boundedly, until they are found again."""

from dataclasses import replace

from fieldnav.messages import CameraName, Direction, Evidence, Frame, Twist
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import comb_of
from fieldnav.perception.perceive import View, find
from states.agreement import Agreement
from states.behaviour import Observation, Sight, Step, Task
from states.guide import Look
from states.lane_watch import LANE_ENDED, driven_m, end_evidence, watch_end
from states.memory import LaneMemory
from states.names import Event

AGREEING_FRAMES = 3
ELSEWHERE = 0.25
"""Of the row spacing, at the middle of the view: further from its path the lane found afresh gainsays it."""


class Coasting:
    """Looks for plants where the rows must be, and for the lane afresh; gives up after the longest gap."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.leading,)
        self._task, self._direction, self._lane = task, direction, lane
        self._agreement = Agreement(AGREEING_FRAMES)
        self._seen_again = 0
        self._entered_m: float | None = None
        self._step = Step()

    def step(self, seen: Observation) -> Step:
        if self._entered_m is None:
            self._entered_m = driven_m(seen, self._direction)
        frame = seen.frames.get(self._direction.leading)
        if frame is not None:
            self._step = self._judge(frame, seen)
        speed_mps = self._task.crop.speeds.acquire_mps
        motion = self._lane.guide.motion(seen.pose, speed_mps, self._direction.leading)
        if self._step.event is Event.FAIL:
            motion = replace(motion, twist=Twist())
        return self._step.with_motion(motion) if frame is not None else self._step.continued(motion)

    def _judge(self, frame: Frame, seen: Observation) -> Step:
        crop, guide = self._task.crop, self._lane.guide
        found = find(frame.image, crop, self._task.cameras[frame.camera])
        look = guide.look(frame, found.centres, seen.exposed_at(frame))
        end = watch_end(self._lane, frame, found.centres, look.rows, seen, self._direction, self._task)
        again = 2 * look.rows_seen >= crop.rows.per_lane and not self._elsewhere(found, frame, look)
        self._seen_again = self._seen_again + 1 if again else 0
        agreed = self._agreement.add(found.lane)
        coasted_m = driven_m(seen, self._direction) - (self._entered_m or 0.0)
        evidence = (
            *end_evidence(end, LANE_ENDED),
            Evidence("frames that show the rows again", self._seen_again, AGREEING_FRAMES, "frames"),
            *self._agreement.evidence(),
            Evidence("coasted", coasted_m, crop.row_end.longest_gap_m, "m"),
            *guide.evidence(seen.pose),
        )
        event, reason = self._found(found, again, frame, seen) if agreed else (None, "")
        if self._seen_again >= AGREEING_FRAMES:
            event, reason = Event.ROWS_FOUND, ""
        elif event is None and not again and end.probability >= LANE_ENDED:
            event = Event.LANE_ENDED
        elif event is None:
            reason = guide.lost(seen.pose) or self._too_long(coasted_m)
            event = Event.FAIL if reason else None
        sight = Sight(frame, look.rows, found.centres)
        return Step(event=event, evidence=evidence, sight=sight, reason=reason)

    def _found(self, found: View, again: bool, frame: Frame, seen: Observation) -> tuple[Event, str]:
        """The lane found afresh; where it is the guide's own come again, what that has learnt is kept."""
        if not found.lane or again:
            return Event.ROWS_FOUND, ""
        self._lane.guide.begin(found.lane, frame, seen.exposed_at(frame))
        self._lane.end.look_again()
        return Event.ROWS_FOUND, "the lane was found afresh"

    def _elsewhere(self, found: View, frame: Frame, look: Look) -> bool:
        """Whether the rows just found run beside the path, on which weeds may stand for crop."""
        if found.lane is None:
            return False
        crop, plane = self._task.crop, canopy_plane(self._task.cameras[frame.camera], self._task.crop)
        path, seen = (comb_of(rows, crop, plane) for rows in (look.rows, found.lane.rows))
        return abs(seen.offset_m - path.offset_m) > ELSEWHERE * crop.rows.spacing_m

    def _too_long(self, coasted_m: float) -> str:
        if coasted_m > self._task.crop.row_end.longest_gap_m:
            return "rows lost for longer than the profile's longest gap"
        return ""
