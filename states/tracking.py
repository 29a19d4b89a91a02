"""Follow.Tracking: follow the rows with the leading camera until they end (paper phase 1, III-A.3, III-B)."""

from math import degrees

from fieldnav.control.servoing import yaw_rate
from fieldnav.messages import CameraName, Direction, Evidence, Motion, Twist
from fieldnav.perception.image_halves import ImagePart
from fieldnav.perception.plants import find_plants
from fieldnav.perception.row_end import crop_in_rows
from fieldnav.perception.tracking import feature, track
from states.behaviour import Observation, Sight, Step, Task
from states.emptiness import Emptiness
from states.memory import LaneMemory
from states.names import Event

LOST_S = 0.6
"""So long may fewer than half of the rows be seen while there still is crop ahead."""


class Tracking:
    """Steers by the average line of the tracked rows; judges whether they are lost or at their end."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.leading,)
        self._task, self._direction, self._lane = task, direction, lane
        self._end = Emptiness(task.crop.row_end.confirm_s, task.crop.row_end.confirm_m)
        self._well_seen_s: float | None = None
        self._step = Step()

    def step(self, seen: Observation) -> Step:
        frame = seen.frames.get(self._direction.leading)
        if frame is None:
            return self._step.continued()
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        assert self._lane.leading, "Acquiring hands over the rows"
        centres = find_plants(frame.image, crop.vegetation, camera)
        rows = self._lane.leading = track(self._lane.leading, centres, frame.stamp_s, crop, camera)
        line = feature(rows.rows, camera)
        speed_mps = crop.speeds.follow_mps
        turn_rps = yaw_rate(line, camera, speed_mps, crop.servoing)
        motion = Motion(Twist(vx_mps=self._direction.sign * speed_mps, yaw_rate_rps=turn_rps))

        ahead = crop_in_rows(centres, rows.rows, crop, camera, ImagePart.TOP)
        crop_ahead = ahead > crop.row_end.least_crop
        ended = self._end.add(crop_ahead, frame.stamp_s, seen.forward_m)
        unseen_s = self._poorly_seen_s(rows.rows_seen, frame.stamp_s)
        evidence = (
            Evidence("crop in the top half", ahead, crop.row_end.least_crop, "rows"),
            *self._end.evidence("top half"),
            Evidence("rows seen", rows.rows_seen, len(rows.rows) / 2, "rows"),
            Evidence("rows poorly seen for", unseen_s, LOST_S, "s"),
            Evidence("feature offset", line.offset_px, None, "px"),
            Evidence("feature angle", degrees(line.theta_rad), None, "deg"),
        )
        sight = Sight(frame, rows.rows, centres, line)
        self._lane.counts[rows.rows_seen] += 1
        event = None
        if ended:
            event = Event.LANE_ENDED
        elif unseen_s > LOST_S and crop_ahead:
            event = Event.ROWS_LOST
        self._step = Step(motion, event, evidence, sight)
        return self._step

    def _poorly_seen_s(self, rows_seen: int, stamp_s: float) -> float:
        if self._well_seen_s is None or 2 * rows_seen >= self._task.crop.rows.per_lane:
            self._well_seen_s = stamp_s
        return stamp_s - self._well_seen_s
