"""Follow.Acquiring: find the lane's rows in the leading camera before following them."""

from dataclasses import replace

from fieldnav.estimation.lane_end import LaneEnd
from fieldnav.messages import Bound, CameraName, Direction, Evidence, Motion, Twist
from fieldnav.perception.perceive import find
from fieldnav.perception.second_witness import NO_FIELD
from states.agreement import Agreement
from states.behaviour import Observation, Sight, Step, Task
from states.guides import guide_for, steering_of
from states.judgement import first_of, second_opinion
from states.lane_watch import driven_m
from states.memory import LaneMemory
from states.names import Event

AGREEING_FRAMES = 4
STANDING_LOOK_S = 1.0
"""A robot that stands looks this long before it creeps on for a better view."""
CREEP_LIMIT_M = 1.0
"""About the length of the view: what was not found by then is not there."""


class Acquiring:
    """Stands, then creeps straight on, until several frames agree on the lane."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.leading,)
        self._task, self._direction, self._lane = task, direction, lane
        self._agreement = Agreement(AGREEING_FRAMES)
        self._entered: tuple[float, float] | None = None
        self._step = Step()

    def step(self, seen: Observation) -> Step:
        entered_s, entered_m = self._entered = self._entered or (seen.now_s, seen.forward_m)
        frame = seen.frames.get(self._direction.leading)
        if frame is None:
            return self._step.continued()
        camera = self._task.cameras[frame.camera]
        found = find(frame.image, self._task.crop, camera)
        crept_m = abs(seen.forward_m - entered_m)
        self._agreement.add(found.lane)
        evidence = (
            *self._agreement.evidence(Event.ROWS_FOUND),
            Evidence("rows of the lane in view", found.lane.rows_seen if found.lane else 0, None, "rows"),
            *second_opinion(found),
            Evidence("crept", crept_m, CREEP_LIMIT_M, "m", Event.FAIL, Bound.ABOVE),
        )
        event = first_of(evidence, Event.ROWS_FOUND, Event.FAIL)
        sight = Sight(frame, found.lane.rows if found.lane else found.lines, found.centres)
        motion = self._creep(seen.now_s - entered_s)
        if event is Event.ROWS_FOUND and found.lane:
            begin_m = driven_m(seen, self._direction) - CREEP_LIMIT_M
            end = LaneEnd(self._task.crop, begin_m, self._lane.expected_m, self._lane.from_m)
            self._lane.enter(guide_for(self._task, self._direction), end)
            self._lane.guide.begin(found.lane, frame, seen.exposed_at(frame))
            self._lane.counts[found.lane.rows_seen] += 1
            return Step(motion, event, evidence, sight)
        if event is Event.FAIL:
            reason = NO_FIELD if found.no_field else "no rows found"
            return Step(replace(motion, twist=Twist()), event, evidence, sight, reason)
        self._step = Step(motion, None, evidence, sight)
        return self._step

    def _creep(self, looked_s: float) -> Motion:
        steering = steering_of(self._task.crop)
        if not self._lane.under_way and looked_s < STANDING_LOOK_S:
            return Motion(steering=steering)
        return Motion(Twist(vx_mps=self._direction.sign * self._task.crop.speeds.acquire_mps), steering)
