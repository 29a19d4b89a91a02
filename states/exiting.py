"""Exit: drive out of the lane guided by the trailing camera (paper phase 2)."""

from math import degrees

import numpy as np

from fieldnav.control.servoing import yaw_rate
from fieldnav.messages import CameraName, Centres, Direction, Evidence, Frame, Motion, Twist
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.image_halves import ImagePart
from fieldnav.perception.perceive import lane_of
from fieldnav.perception.plants import plants_in
from fieldnav.perception.row_end import crop_in_rows, nearest_crop_m
from fieldnav.perception.tracking import TrackedRows, feature, start, track
from fieldnav.perception.vegetation import Cover, vegetation_of
from fieldnav.pinhole import Pinhole
from states.agreement import Agreement
from states.behaviour import Observation, Sight, Step, Task
from states.emptiness import Emptiness
from states.memory import LaneMemory
from states.names import Event

AGREEING_FRAMES = 2
FRAMES_TO_RETURN = 4
"""So many frames of the leading camera must agree that rows have come again: the end was a gap."""


SLOWEST_MPS = 0.08
APPROACH_PER_S = 1.0


class Exiting:
    """Steers by the trailing camera until its lower half is empty; follows again if rows come again."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.leading, direction.trailing)
        self._task, self._direction, self._lane = task, direction, lane
        self._found = Agreement(AGREEING_FRAMES)
        self._again = Agreement(FRAMES_TO_RETURN)
        self._end = Emptiness(task.crop.row_end.exit_confirm_s, task.crop.row_end.exit_confirm_m)
        self._entered_m: float | None = None
        lane.trailing = None
        self._step = Step(self._ahead(0.0, task.crop.speeds.exit_mps))

    def step(self, seen: Observation) -> Step:
        if self._entered_m is None:
            self._entered_m = seen.forward_m
        leading, trailing = (seen.frames.get(name) for name in self.cameras)
        if leading is not None and self._rows_again(leading):
            self._lane.under_way = True
            reason = "rows come again: it was a gap"
            return Step(
                self._step.motion, Event.ROWS_SEEN_AGAIN, self._again.evidence(), Sight(leading), reason
            )
        if trailing is not None:
            self._step = self._guided(trailing, seen, abs(seen.forward_m - self._entered_m))
            return self._step
        return self._step.continued()

    def _rows_again(self, frame: Frame) -> bool:
        camera = self._task.cameras[frame.camera]
        crop = self._task.crop
        ahead = vegetation_of(frame.image, crop.vegetation).part(ImagePart.TOP)
        lane = lane_of(ahead, plants_in(ahead, crop.vegetation, camera), crop, camera)
        enough = lane is not None and 2 * lane.rows_seen > self._task.crop.rows.per_lane
        return self._again.add(lane if enough else None)

    def _guided(self, frame: Frame, seen: Observation, driven_m: float) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        cover = vegetation_of(frame.image, crop.vegetation)
        centres = plants_in(cover, crop.vegetation, camera)
        rows = self._follow(cover, centres, frame.stamp_s, camera)
        # From where the leading view's middle meets the last plants to where the trailing view's does.
        whole_m = sum(camera.view_m)
        if rows is None:
            return self._unguided(frame, centres, driven_m, whole_m)
        speed_mps = self._speed_mps(rows, centres, camera)
        line = feature(rows.rows, camera)
        turn_rps = yaw_rate(line, camera, -speed_mps, crop.servoing.leaving)
        behind = crop_in_rows(centres, rows.rows, crop, camera, ImagePart.BOTTOM)
        ended = self._end.add(behind > crop.row_end.least_crop, frame.stamp_s, seen.forward_m)
        evidence = (
            Evidence("crop in the bottom half", behind, crop.row_end.least_crop, "rows"),
            *self._end.evidence("bottom half"),
            Evidence("driven out", driven_m, whole_m / 2, "m"),
            Evidence("feature offset", line.offset_px, None, "px"),
            Evidence("feature angle", degrees(line.theta_rad), None, "deg"),
        )
        sight = Sight(frame, rows.rows, centres, line)
        if driven_m > 2 * whole_m:
            return Step(Motion(), Event.FAIL, evidence, sight, "crop behind does not end")
        if not (ended and driven_m > whole_m / 2):
            return Step(self._ahead(turn_rps, speed_mps), None, evidence, sight)
        entered_m = self._lane.entered_m
        if entered_m is not None:
            evidence = (
                *evidence,
                Evidence("driven in this lane", abs(seen.forward_m - entered_m), None, "m"),
            )
        last = self._lane.number >= self._task.lanes
        return Step(Motion(), Event.LAST_LANE_LEFT if last else Event.LANE_LEFT, evidence, sight)

    def _unguided(self, frame: Frame, centres: Centres, driven_m: float, whole_m: float) -> Step:
        """Straight on until the trailing camera has found the rows, but no further than the exit is long."""
        evidence = (Evidence("driven out unguided", driven_m, whole_m, "m"),)
        sight = Sight(frame, (), centres)
        if driven_m > whole_m:
            return Step(Motion(), Event.FAIL, evidence, sight, "no rows behind to leave by")
        return Step(self._ahead(0.0, self._task.crop.speeds.exit_mps), None, evidence, sight)

    def _follow(self, cover: Cover, centres: Centres, stamp_s: float, camera: Pinhole) -> TrackedRows | None:
        crop = self._task.crop
        if self._lane.trailing is not None:
            self._lane.trailing = track(self._lane.trailing, centres, stamp_s, crop, camera)
            return self._lane.trailing
        lane = lane_of(cover, centres, crop, camera)
        if self._found.add(lane) and lane:
            self._lane.trailing = start(lane, stamp_s)
        return self._lane.trailing

    def _speed_mps(self, rows: TrackedRows, centres: Centres, camera: Pinhole) -> float:
        """Slower as the last plants near the view's middle: each centimetre past it shows less of them."""
        crop = self._task.crop
        nearest_m = nearest_crop_m(centres, rows.rows, crop, camera)
        middle = np.array([camera.centre_x_px, camera.centre_y_px])
        middle_m = float(canopy_plane(camera, crop).to_ground(middle)[0])
        left_m = max(0.0, middle_m - nearest_m) if nearest_m is not None else 0.0
        return min(crop.speeds.exit_mps, SLOWEST_MPS + APPROACH_PER_S * left_m)

    def _ahead(self, turn_rps: float, speed_mps: float) -> Motion:
        return Motion(Twist(vx_mps=self._direction.sign * speed_mps, yaw_rate_rps=turn_rps))
