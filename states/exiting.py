"""Exit: drive out of the lane guided by the trailing camera (paper phase 2)."""

from dataclasses import replace

from fieldnav.estimation.lane_end import LaneEndView
from fieldnav.messages import Bound, CameraName, Direction, Evidence, Frame, Motion, Twist
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.perceive import find
from fieldnav.perception.plants import find_plants
from states.agreement import Agreement
from states.behaviour import Observation, Sight, Step, Task
from states.guides import steering_of
from states.judgement import first_of, second_opinion
from states.lane_watch import SURE, driven_m, end_evidence, watch_end
from states.memory import LaneMemory
from states.names import Event

SLOWEST_MPS, APPROACH_PER_S = 0.08, 1.0
"""Speed at the place to stop, and how much faster for each metre before it."""
AGAIN = 0.3
"""Probability of an end below which it was a gap."""
BEYOND_M = 1.0
"""Past the place to stop, a robot that is still not sure of the end goes no further than this."""
AHEAD_EVERY_S = 0.1
"""Between looks ahead: half of a camera's frames. Our choice."""
AGREEING_FRAMES = 3
"""Frames that must show the same lane afresh before the end is judged along its rows."""


class Exiting:
    """Steers by the trailing camera to just past the last plants; follows again if crop comes again."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self._both = (direction.leading, direction.trailing)
        self.cameras: tuple[CameraName, ...] = self._both
        self._ahead_s: float | None = None
        self._task, self._direction, self._lane = task, direction, lane
        self._end: LaneEndView = lane.end.judge()
        self._agreement = Agreement(AGREEING_FRAMES)
        self._step = Step()

    def step(self, seen: Observation) -> Step:
        leading, trailing = (seen.frames.get(name) for name in self._both)
        self.cameras = self._both if self._due_ahead(seen.now_s, leading) else (self._direction.trailing,)
        step = self._ahead(leading, seen) if leading is not None else self._step.continued()
        if trailing is not None and step.event is None:
            behind = self._behind(trailing, seen)
            step = replace(behind, evidence=(*behind.evidence, *step.evidence))
        self._step = step.with_motion(self._motion(seen, step))
        return self._step

    def _due_ahead(self, now_s: float, leading: Frame | None) -> bool:
        """Whether it is time to look ahead again; it is less urgent than what is steered by."""
        if leading is not None:
            self._ahead_s = now_s
        return self._ahead_s is None or now_s - self._ahead_s >= AHEAD_EVERY_S

    def _ahead(self, frame: Frame, seen: Observation) -> Step:
        """What the leading camera says: nothing more, or crop again, be it beside where the rows should run.

        Over a gap the lane's path is drawn on from before it. Where that was little, rows come again so far
        aside that their plants seem to stand between them: so the lane is looked for afresh, too.
        """
        guide, pose = self._lane.guide, seen.exposed_at(frame)
        found = find(frame.image, self._task.crop, self._task.cameras[frame.camera])
        afresh = found.lane if self._agreement.add(found.lane) else None
        rows, centres = afresh.rows if afresh else guide.rows(frame.camera, pose), found.centres
        self._end = watch_end(self._lane, frame, centres, rows, seen, self._direction, self._task)
        begins_m = driven_m(seen, self._direction, frame) + self._nearest_seen_m(frame)
        evidence = (*self._again_evidence(begins_m), *second_opinion(found))
        event = first_of(evidence, Event.ROWS_SEEN_AGAIN)
        if event is None:
            return replace(self._step.continued(), evidence=evidence)
        if afresh:
            guide.begin(afresh, frame, pose)
            self._lane.end.look_again()
        reason = "crop comes again: it was a gap"
        return Step(event=event, evidence=evidence, sight=Sight(frame, rows, centres), reason=reason)

    def _again_evidence(self, begins_m: float) -> tuple[Evidence, ...]:
        """Whether it was a gap: the end is unlikely, or a lane is found afresh past the last crop."""
        again, likely, until_m = Event.ROWS_SEEN_AGAIN, self._end.probability, self._end.crop_until_m
        return (
            Evidence("probability of an end ahead", likely, AGAIN, "", again, Bound.BELOW, alone=True),
            *self._agreement.evidence(again),
            Evidence("where the view ahead begins", begins_m, until_m, "m", again, Bound.ABOVE),
        )

    def _behind(self, frame: Frame, seen: Observation) -> Step:
        guide, camera = self._lane.guide, self._task.cameras[frame.camera]
        centres = find_plants(frame.image, self._task.crop.vegetation, camera)
        look = guide.look(frame, centres, seen.exposed_at(frame))
        self._lane.trailing = look if look.rows else self._lane.trailing
        self._end = watch_end(self._lane, frame, centres, look.rows, seen, self._direction, self._task)
        left = Event.LAST_LANE_LEFT if self._lane.number >= self._task.lanes else Event.LANE_LEFT
        evidence = (
            *self._left_evidence(self._left_m(seen), left),
            Evidence("length of this lane", self._lane.end.length_m(), None, "m"),
            Evidence("rows seen behind", look.rows_seen, None, "rows"),
            *guide.evidence(seen.pose),
        )
        sight = Sight(frame, look.rows, centres, guide.feature)
        event = first_of(evidence, left, Event.FAIL)
        reason = "no crop either way, and yet the lane should not end here" if event is Event.FAIL else ""
        return Step(event=event, evidence=evidence, sight=sight, reason=reason)

    def _left_evidence(self, left_m: float, left: Event) -> tuple[Evidence, ...]:
        """Whether the lane is left for good; far past the place to stop a robot that is not sure gives up."""
        looks = self._agreement.looks
        return (
            *end_evidence(self._end, SURE, left),
            Evidence("to the place to stop", left_m, 0.0, "m", left, Bound.AT_MOST),
            Evidence("frames that show a lane ahead", looks, 0, "frames", left, Bound.AT_MOST),
            Evidence("past the place to stop", -left_m, BEYOND_M, "m", Event.FAIL, Bound.ABOVE),
        )

    def _nearest_seen_m(self, frame: Frame) -> float:
        """How far ahead of the robot's centre the leading view begins: a lane in it may be the one left."""
        return canopy_plane(self._task.cameras[frame.camera], self._task.crop).view_m[0]

    def _left_m(self, seen: Observation) -> float:
        """Way to where the trailing camera stands as far past the last crop as the profile says."""
        camera_m = self._task.cameras[self._direction.trailing].forward_m
        stop_m = self._end.crop_until_m + self._task.crop.switching.headland_m + camera_m
        return stop_m - driven_m(seen, self._direction)

    def _motion(self, seen: Observation, step: Step) -> Motion:
        if step.event in (Event.LANE_LEFT, Event.LAST_LANE_LEFT, Event.FAIL):
            return Motion(Twist(), steering_of(self._task.crop))
        speed_mps = SLOWEST_MPS + APPROACH_PER_S * max(0.0, self._left_m(seen))
        speed_mps = min(self._task.crop.speeds.exit_mps, speed_mps)
        return self._lane.guide.motion(seen.pose, speed_mps, self._direction.trailing)
