"""Follow.Tracking: follow the rows with the leading camera until they end (paper phase 1, III-A.3, III-B)."""

from fieldnav.messages import Bound, CameraName, Direction, Evidence, Frame
from fieldnav.perception.plants import find_plants
from fieldnav.perception.second_witness import BORNE_OUT, share_borne_out
from states.behaviour import Observation, Sight, Step, Task
from states.guide import Look
from states.judgement import first_of
from states.lane_watch import LANE_ENDED, driven_m, end_evidence, watch_end
from states.memory import LaneMemory
from states.names import Event

LOST_M = 0.25
"""Over so much driving may fewer than half of the rows be seen."""
DOUBT_EVERY_M, DOUBTED_M = 0.25, 1.0
"""How often the network is asked about the rows followed, and how far they are followed against its word."""


class Tracking:
    """Steers by the lane's guide; judges whether the rows are lost or at their end."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.leading,)
        self._task, self._direction, self._lane = task, direction, lane
        self._well_seen_m: float | None = None
        self._asked_m: float | None = None
        self._borne_out_m: float | None = None
        self._step = Step()

    def step(self, seen: Observation) -> Step:
        frame = seen.frames.get(self._direction.leading)
        if frame is not None:
            self._step = self._judge(frame, seen)
        speed_mps = self._task.crop.speeds.follow_mps
        motion = self._lane.guide.motion(seen.pose, speed_mps, self._direction.leading)
        return self._step.with_motion(motion) if frame is not None else self._step.continued(motion)

    def _judge(self, frame: Frame, seen: Observation) -> Step:
        crop, camera, guide = self._task.crop, self._task.cameras[frame.camera], self._lane.guide
        centres = find_plants(frame.image, crop.vegetation, camera)
        look = guide.look(frame, centres, seen.exposed_at(frame))
        end = watch_end(self._lane, frame, centres, look.rows, seen, self._direction, self._task)
        self._lane.counts[look.rows_seen] += 1
        driven = driven_m(seen, self._direction, frame)
        unseen_m = self._poorly_seen_m(look.rows_seen, driven)
        doubted_m = self._doubted_m(frame, look, driven)
        evidence = (
            *end_evidence(end, LANE_ENDED, Event.LANE_ENDED),
            Evidence(
                "rows seen", look.rows_seen, crop.rows.per_lane / 2, "rows", Event.ROWS_LOST, Bound.BELOW
            ),
            Evidence("rows poorly seen over", unseen_m, LOST_M, "m", Event.ROWS_LOST, Bound.ABOVE),
            Evidence(
                "rows not borne out by the network over",
                doubted_m,
                DOUBTED_M,
                "m",
                Event.ROWS_LOST,
                Bound.ABOVE,
                alone=True,
            ),
            *guide.evidence(seen.pose),
        )
        event = first_of(evidence, Event.LANE_ENDED, Event.ROWS_LOST)
        return Step(event=event, evidence=evidence, sight=Sight(frame, look.rows, centres, guide.feature))

    def _poorly_seen_m(self, rows_seen: int, driven: float) -> float:
        if self._well_seen_m is None or 2 * rows_seen >= self._task.crop.rows.per_lane:
            self._well_seen_m = driven
        return driven - self._well_seen_m

    def _doubted_m(self, frame: Frame, look: Look, driven: float) -> float:
        """How far the rows that vegetation shows have been followed while the network saw none of them."""
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        if self._borne_out_m is None or not look.rows or not crop.finding.second_witness:
            self._borne_out_m = driven
        elif self._asked_m is None or driven - self._asked_m >= DOUBT_EVERY_M:
            self._asked_m = driven
            if share_borne_out(frame.image, look.rows, crop, camera) >= BORNE_OUT:
                self._borne_out_m = driven
        return driven - self._borne_out_m
