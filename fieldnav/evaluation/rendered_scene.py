"""Rendered pictures of a robot in a lane, and the rows that truly show in them.

The truth is a row's line in the plane through the canopy's middle, not on the soil: there lies the middle of
what a camera sees of a plant, where a person who marks rows in a picture clicks and where perception reports
them. The camera as it truly hung at that moment projects it; perception is told what a calibration would say.
"""

from dataclasses import dataclass, replace
from math import cos, pi, radians, sin

import numpy as np

from fieldnav.evaluation.rendered_truth import (
    POINT_STEP_M,
    REACH_M,
    as_it_hangs,
    in_picture,
    seen_at,
    straight_line,
    view_from,
)
from fieldnav.messages import Image, RowLine
from fieldnav.perception.canopy import VISIBLE_HEIGHT
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_robot
from fieldnav.simulation.plan import FieldPlan
from fieldnav.simulation.renderer import FieldRenderer, View
from fieldnav.simulation.sensor import Sensor
from fieldnav.simulation.shaking import Shaking

WIDEST_OFFSET_M, WIDEST_HEADING_RAD = 0.10, radians(5.0)  # of the robot's centre from its lane; our choice
DRIVE_S, FRAMES = 600.0, 9000  # moments to draw from: ten minutes at 15 frames/s
FEWEST_PLANTS = 2  # of a row that shows: one plant alone has no direction, neither for an annotator


@dataclass(frozen=True, slots=True)
class Place:
    """Where the robot stands: `s_m` along a lane, left of its middle, turned from the lane's direction."""

    lane: int
    s_m: float
    offset_m: float = 0.0
    turn_rad: float = 0.0


@dataclass(frozen=True, slots=True)
class Shot:
    """A picture, the camera that took it as perception believes it to be, and the rows that show."""

    image: Image
    camera: Pinhole
    truth: tuple[RowLine, ...]


class Scene:
    """A sown field and the front camera over it; `robot` is the name of a shipped robot."""

    def __init__(
        self, field: FieldSettings, crop: CropProfile, plan: FieldPlan, robot: str = "bonnbot"
    ) -> None:
        camera = load_robot(robot).cameras.front.pinhole()
        self.plan, self.camera = plan, camera
        self._errors, self._crop = field.camera_errors, crop
        self._speed_mps = float(crop.speeds.follow_mps)
        self._renderer = FieldRenderer(plan, field, crop)
        self._sensor = Sensor(field.camera_errors, camera.width_px, camera.height_px, field.seed)
        self._shaking = Shaking(field.camera_errors, field.seed, field.mirrored)

    def random_place(self, random: np.random.Generator) -> Place:
        """Somewhere in a lane, looking along it or against it, with rows as far as the camera sees."""
        lane = self.plan.sown_lanes[int(random.integers(len(self.plan.sown_lanes)))]
        first_m = float(self.plan.s_first_m[lane].max()) + REACH_M
        last_m = float(self.plan.s_last_m[lane].min()) - REACH_M
        offset, turn = random.uniform(-1, 1, 2) * (WIDEST_OFFSET_M, WIDEST_HEADING_RAD)
        return Place(lane, random.uniform(first_m, last_m), offset, turn + pi * int(random.integers(2)))

    def shoot(self, place: Place, tilt_rad: float, random: np.random.Generator) -> Shot:
        """Take a picture while driving; shaking and the calibration's errors are drawn anew."""
        time_s, sequence = random.uniform(0, DRIVE_S), int(random.integers(FRAMES))
        view = self._view(place, tilt_rad, time_s, random)
        told = replace(self.camera, tilt_rad=tilt_rad)
        across_px = float(told.pixels_per_metre(told.centre_y_px))
        smear_px = self._speed_mps * self._errors.exposure_s * across_px * sin(tilt_rad)
        image = self._sensor.expose(self._renderer.render(view, time_s), sequence, (0.0, smear_px))
        return Shot(image, told, self._rows_in(view, place))

    def _view(self, place: Place, tilt_rad: float, time_s: float, random: np.random.Generator) -> View:
        attitude = self._shaking.at(time_s, self._speed_mps)
        told = replace(self.camera, tilt_rad=tilt_rad)
        camera = as_it_hangs(told, self._errors, random.uniform(-1, 1, 3))
        n = float(self.plan.rows.lane_n(place.lane, place.s_m))
        middle = self.plan.centreline.position(place.s_m, n)
        lane_rad = float(self.plan.in_lane(place.lane, middle)[2])
        aside = np.array([-sin(lane_rad), cos(lane_rad)]) * place.offset_m
        return view_from(camera, middle + aside, lane_rad + place.turn_rad, attitude)

    def _rows_in(self, view: View, place: Place) -> tuple[RowLine, ...]:
        """The true lines of those rows of the lane that show."""
        height_m = VISIBLE_HEIGHT * self._crop.plants.canopy_height_m
        s = np.arange(place.s_m - REACH_M, place.s_m + REACH_M, POINT_STEP_M)
        plants, truth = self.plan.plants, []
        for row in range(self.plan.rows_per_lane):
            own = plants.is_crop & (plants.lane == place.lane) & (plants.row == row)
            stems = np.stack([plants.x_m[own], plants.y_m[own]], axis=-1)
            if in_picture(seen_at(view, stems, height_m), view) >= FEWEST_PLANTS:
                line = self.plan.centreline.position(s, self.plan.rows.row_n(place.lane, row, s))
                truth.append(straight_line(seen_at(view, line, height_m), view.height_px))
        return tuple(truth)
