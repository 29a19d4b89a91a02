"""Rendered pictures of a robot that steps sideways over lanes, and where every row truly runs in each."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from fieldnav.evaluation.rendered_truth import POINT_STEP_M, REACH_M, as_it_hangs, seen_at, view_from
from fieldnav.messages import Floats, Image, Side
from fieldnav.perception.canopy import VISIBLE_HEIGHT
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer, View
from fieldnav.simulation.sensor import Sensor
from fieldnav.simulation.shaking import Shaking

FRAMES_PER_S = 15.0


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
        self._crop, camera = crop, robot.cameras.front.pinhole()
        self._plan = sow(field, crop, Side.RIGHT)
        self._renderer = FieldRenderer(self._plan, field, crop)
        self._sensor = Sensor(errors, camera.width_px, camera.height_px, field.seed)
        self._shaking = Shaking(errors, field.seed, field.mirrored)
        self._hung = as_it_hangs(camera, errors, np.random.default_rng(field.seed).uniform(-1, 1, 3))

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
        place_m = self._plan.centreline.position(along_m, -right_m)
        return view_from(self._hung, place_m, heading_rad, self._shaking.at(time_s, speed_mps))

    def _beside_px(self, view: View, along_m: float) -> Floats:
        s = np.arange(along_m - REACH_M, along_m + REACH_M, POINT_STEP_M)
        lines = [
            self._plan.centreline.position(s, self._plan.rows.row_n(lane, row, s))
            for lane in range(self._plan.lanes)
            for row in reversed(range(self._plan.rows_per_lane))
        ]
        return np.array([self._at_mid_height_px(view, line) for line in lines])

    def _at_mid_height_px(self, view: View, line_m: Floats) -> float:
        point_px = seen_at(view, line_m, VISIBLE_HEIGHT * self._crop.plants.canopy_height_m)
        x, y = point_px[np.argsort(point_px[:, 1])].T
        return float(np.interp((view.height_px - 1) / 2, y, x)) - (view.width_px - 1) / 2
