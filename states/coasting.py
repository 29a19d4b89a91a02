"""Follow.Coasting: rows lost for a moment; straight on, slowly and boundedly, until they are found again."""

from fieldnav.messages import CameraName, Direction, Evidence, Motion, Twist
from fieldnav.perception.image_halves import ImagePart
from fieldnav.perception.perceive import find
from fieldnav.perception.row_end import crop_in_rows
from fieldnav.perception.tracking import start
from states.agreement import Agreement
from states.behaviour import Observation, Sight, Step, Task
from states.emptiness import Emptiness
from states.memory import LaneMemory
from states.names import Event

AGREEING_FRAMES = 3


class Coasting:
    """Looks for the lane afresh in every frame; gives up after the longest gap the profile allows."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.leading,)
        self._task, self._direction, self._lane = task, direction, lane
        self._agreement = Agreement(AGREEING_FRAMES)
        self._end = Emptiness(task.crop.row_end.confirm_s, task.crop.row_end.confirm_m)
        self._entered_m: float | None = None
        self._step = Step(Motion(Twist(vx_mps=direction.sign * task.crop.speeds.acquire_mps)))

    def step(self, seen: Observation) -> Step:
        if self._entered_m is None:
            self._entered_m = seen.forward_m
        frame = seen.frames.get(self._direction.leading)
        if frame is None:
            return self._step.continued()
        found = find(frame.image, self._task.crop, self._task.cameras[frame.camera])
        agreed = self._agreement.add(found.lane)
        coasted_m = abs(seen.forward_m - self._entered_m)
        limit_m = self._task.crop.row_end.longest_gap_m
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        assert self._lane.leading, "the rows were followed before they were lost"
        ahead = crop_in_rows(found.centres, self._lane.leading.rows, crop, camera, ImagePart.TOP)
        ended = self._end.add(ahead > crop.row_end.least_crop, frame.stamp_s, seen.forward_m)
        evidence = (
            *self._agreement.evidence(),
            *self._end.evidence("top half"),
            Evidence("coasted", coasted_m, limit_m, "m"),
        )
        sight = Sight(frame, found.lane.rows if found.lane else found.lines, found.centres)
        if agreed and found.lane:
            self._lane.leading = start(found.lane, frame.stamp_s)
            return Step(self._step.motion, Event.ROWS_FOUND, evidence, sight)
        if ended:
            return Step(self._step.motion, Event.LANE_ENDED, evidence, sight)
        if coasted_m > limit_m:
            return Step(
                Motion(), Event.FAIL, evidence, sight, "rows lost for longer than the profile's longest gap"
            )
        self._step = Step(self._step.motion, None, evidence, sight)
        return self._step
