"""Follow.Coasting: rows lost for a moment; on along the lane, boundedly, until they are found again."""

from dataclasses import replace

from fieldnav.messages import Bound, CameraName, Direction, Evidence, Frame, Twist
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import comb_of
from fieldnav.perception.lane import LaneFit
from fieldnav.perception.perceive import View, find
from fieldnav.perception.second_witness import NO_FIELD
from states.agreement import Agreement
from states.behaviour import Observation, Sight, Step, Task
from states.guide import Look
from states.judgement import first_of, holds, second_opinion
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
        on_path = self._on_path(found, frame, look)
        again = all(map(holds, on_path)) and not found.no_field
        self._seen_again = self._seen_again + 1 if again else 0
        self._agreement.add(found.lane)
        coasted_m = driven_m(seen, self._direction) - (self._entered_m or 0.0)
        most_m = crop.row_end.longest_gap_m
        evidence = (
            *end_evidence(end, LANE_ENDED, Event.LANE_ENDED),
            *on_path,
            *second_opinion(found),
            *self._again_evidence(),
            Evidence("coasted", coasted_m, most_m, "m", Event.FAIL, Bound.ABOVE, alone=True),
            *guide.evidence(seen.pose, lost=Event.FAIL),
        )
        event, reason = first_of(evidence, Event.ROWS_FOUND, Event.LANE_ENDED, Event.FAIL), ""
        if event is Event.ROWS_FOUND and found.lane and not again:
            reason = self._found(found.lane, frame, seen)
        elif event is Event.FAIL:
            lost = NO_FIELD if found.no_field else "rows lost for longer than the profile's longest gap"
            reason = guide.lost(seen.pose) or lost
        sight = Sight(frame, look.rows, found.centres)
        return Step(event=event, evidence=evidence, sight=sight, reason=reason)

    def _again_evidence(self) -> tuple[Evidence, ...]:
        """How often the rows were seen again or found afresh; a lane of which a frame shows rows goes on."""
        again, found = self._seen_again, Event.ROWS_FOUND
        return (
            Evidence("frames that show the rows again", again, AGREEING_FRAMES, "frames", found, alone=True),
            Evidence("rows shown again meanwhile", again, 0, "frames", Event.LANE_ENDED, Bound.AT_MOST),
            *self._agreement.evidence(found, alone=True),
        )

    def _found(self, lane: LaneFit, frame: Frame, seen: Observation) -> str:
        """Begin anew with a lane found elsewhere; where it is the guide's own, what was learnt is kept."""
        self._lane.guide.begin(lane, frame, seen.exposed_at(frame))
        self._lane.end.look_again()
        return "the lane was found afresh"

    def _on_path(self, found: View, frame: Frame, look: Look) -> tuple[Evidence, ...]:
        """What makes a frame show the rows: enough of them on the path, and none beside it instead."""
        crop, plane = self._task.crop, canopy_plane(self._task.cameras[frame.camera], self._task.crop)
        enough = Evidence("rows seen", look.rows_seen, crop.rows.per_lane / 2, "rows")
        if found.lane is None or not look.rows:
            return (enough,)
        path, fresh = (comb_of(rows, crop, plane) for rows in (look.rows, found.lane.rows))
        off_m, most_m = abs(fresh.offset_m - path.offset_m), ELSEWHERE * crop.rows.spacing_m
        return (
            enough,
            Evidence("rows found afresh beside the path by", off_m, most_m, "m", None, Bound.AT_MOST),
        )
