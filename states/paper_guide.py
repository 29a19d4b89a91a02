"""The paper's guide: visual servoing on the average line of the tracked rows (III-B)."""

from math import degrees

from fieldnav.control.servoing import yaw_rate
from fieldnav.messages import CameraName, Centres, Direction, Evidence, Frame, Motion, RowLine, Twist
from fieldnav.odometry import Pose
from fieldnav.perception.lane import LaneFit
from fieldnav.perception.perceive import find
from fieldnav.perception.tracking import Feature, TrackedRows, feature, start, track
from states.agreement import Agreement
from states.behaviour import Task
from states.guide import Look
from states.names import Event

AGREEING_FRAMES = 2
"""Of the trailing camera, which finds the rows by itself when the exit begins."""
LOOKED_AWAY_S = 1.0
"""Half a metre at working speed: a camera not looked at for longer finds its rows afresh."""


class PaperGuide:
    """Keeps the rows of each camera in its image, and steers by the line of the camera that leads the way."""

    def __init__(self, task: Task, direction: Direction) -> None:
        self._task, self._direction = task, direction
        self._rows: dict[CameraName, TrackedRows] = {}
        self._agreement = Agreement(AGREEING_FRAMES)
        self.feature: Feature | None = None

    def begin(self, fit: LaneFit, frame: Frame, pose: Pose) -> None:
        self._rows[frame.camera] = start(fit, frame.stamp_s)

    def look(self, frame: Frame, centres: Centres, pose: Pose) -> Look:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        known = self._known(frame)
        if known is not None:
            rows = self._rows[frame.camera] = track(known, centres, frame.stamp_s, crop, camera)
            return Look(rows.rows, rows.rows_seen)
        lane = find(frame.image, crop, camera).lane
        if self._agreement.add(lane) and lane:
            self.begin(lane, frame, pose)
            return Look(lane.rows, lane.rows_seen)
        return Look((), 0)

    def _known(self, frame: Frame) -> TrackedRows | None:
        """The rows of the frame's camera, unless the robot has driven on since that was last looked at."""
        known = self._rows.get(frame.camera)
        if known is not None and frame.stamp_s - known.stamp_s > LOOKED_AWAY_S:
            del self._rows[frame.camera]
            self._agreement = Agreement(AGREEING_FRAMES)
            return None
        return known

    def rows(self, camera: CameraName, pose: Pose) -> tuple[RowLine, ...]:
        known = self._rows.get(camera)
        return known.rows if known else ()

    def motion(self, pose: Pose, speed_mps: float, camera: CameraName) -> Motion:
        rows, sign = self.rows(camera, pose), self._direction.sign
        # A line that is not seen stays in the image however the robot turns: steering by it never ends.
        shown = any(row.confidence > 0 for row in rows)
        self.feature = feature(rows, self._task.cameras[camera]) if shown else None
        if self.feature is None:
            return Motion(Twist(vx_mps=sign * speed_mps))
        leads, servoing = camera is self._direction.leading, self._task.crop.servoing
        towards_mps = speed_mps if leads else -speed_mps
        chosen = servoing if leads else servoing.leaving
        turn_rps = yaw_rate(self.feature, self._task.cameras[camera], towards_mps, chosen)
        return Motion(Twist(vx_mps=sign * speed_mps, yaw_rate_rps=turn_rps))

    def evidence(self, pose: Pose, lost: Event | None = None) -> tuple[Evidence, ...]:
        if self.feature is None:
            return ()
        return (
            Evidence("feature offset", self.feature.offset_px, None, "px"),
            Evidence("feature angle", degrees(self.feature.theta_rad), None, "deg"),
        )

    def lost(self, pose: Pose) -> str:
        return ""
