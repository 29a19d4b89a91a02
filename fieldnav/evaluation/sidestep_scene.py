"""Rendered pictures of a robot that steps sideways over lanes, and where every row truly runs in each."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np

from fieldnav.evaluation.rendered_rows import NEAREST_M, REACH_M
from fieldnav.messages import Floats, Image, Side
from fieldnav.perception.canopy import VISIBLE_HEIGHT
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer, View
from fieldnav.simulation.sensor import Sensor
from fieldnav.simulation.shaking import Shaking, rotation

FRAMES_PER_S = 15.0
POINT_STEP_M = 0.02  # between the points of a true row


@dataclass(frozen=True, slots=True)
class Sidestep:
    """One picture; beside_px: shape (rows,), how far right of the centre each row runs at mid-height."""

    image: Image
    beside_px: Floats


class SidestepScene:
    """A sown field under the front camera of a robot that looks along the rows; its calibration errs.

    Lanes follow each other to the right; rows are counted from the left, lane by lane.
    """

    def __init__(self, field: FieldSettings, crop: CropProfile, robot: Robot) -> None:
        errors = field.camera_errors
        self._camera, self._crop = robot.cameras.front.pinhole(), crop
        self._plan = sow(field, crop, Side.RIGHT)
        self._renderer = FieldRenderer(self._plan, field, crop)
        self._sensor = Sensor(errors, self._camera.width_px, self._camera.height_px, field.seed)
        self._shaking = Shaking(errors, field.seed, field.mirrored)
        tilt, height, focal = np.random.default_rng(field.seed).uniform(-1, 1, 3)
        self._tilt_rad = self._camera.tilt_rad + radians(errors.tilt_error_deg) * tilt
        self._height_m = self._camera.height_m + errors.height_error_m * height
        self._focal_px = self._camera.focal_px * (1 + errors.focal_error * focal)

    def pictures(self, right_m: Floats, along_m: float, heading_rad: float = 0.0) -> Iterator[Sidestep]:
        """A picture at each place right of the first lane's middle, shape (n,), so far along the field."""
        speed_mps = np.abs(np.gradient(right_m)) * FRAMES_PER_S
        for number, (place_m, pace_mps) in enumerate(zip(right_m, speed_mps, strict=True)):
            view = self._view(float(place_m), along_m, heading_rad, number / FRAMES_PER_S, float(pace_mps))
            plain = self._renderer.render(view, number / FRAMES_PER_S)
            yield Sidestep(self._sensor.expose(plain, number, (0.0, 0.0)), self._beside_px(view, along_m))

    def _view(
        self, right_m: float, along_m: float, heading_rad: float, time_s: float, speed_mps: float
    ) -> View:
        attitude, ahead_m = self._shaking.at(time_s, speed_mps), self._camera.forward_m
        x, y = self._plan.centreline.position(along_m, -right_m)
        z = self._height_m + attitude.height_m - ahead_m * sin(attitude.pitch_rad)
        position = np.array([x + ahead_m * cos(heading_rad), y + ahead_m * sin(heading_rad), z])
        turned = rotation(attitude, 1, heading_rad, self._tilt_rad)
        return View(self._camera.width_px, self._camera.height_px, self._focal_px, position, turned)

    def _beside_px(self, view: View, along_m: float) -> Floats:
        s = np.arange(along_m - REACH_M, along_m + REACH_M, POINT_STEP_M)
        lines = [
            self._plan.centreline.position(s, self._plan.rows.row_n(lane, row, s))
            for lane in range(self._plan.lanes)
            for row in reversed(range(self._plan.rows_per_lane))
        ]
        return np.array([self._at_mid_height_px(view, line) for line in lines])

    def _at_mid_height_px(self, view: View, line_m: Floats) -> float:
        height_m = VISIBLE_HEIGHT * self._crop.plants.canopy_height_m
        point = np.column_stack([line_m, np.full(len(line_m), height_m)]) - view.position_m
        u, v, depth = view.projection @ point.T
        before = depth > NEAREST_M
        order = np.argsort(v[before] / depth[before])
        middle = (view.height_px - 1) / 2
        x = np.interp(middle, (v[before] / depth[before])[order], (u[before] / depth[before])[order])
        return float(x) - (view.width_px - 1) / 2
