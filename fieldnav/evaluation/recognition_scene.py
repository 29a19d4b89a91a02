"""Rendered pictures of a robot that steps sideways behind row ends, and the line of every row that shows.

Rows are marked as an annotator or a tracker would: along the plants, a little off.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import radians

import numpy as np

from fieldnav.evaluation.rendered_truth import (
    POINT_STEP_M,
    REACH_M,
    as_it_hangs,
    seen_at,
    straight_line,
    view_from,
)
from fieldnav.messages import Floats, Image, RowLine, Side
from fieldnav.perception.canopy import VISIBLE_HEIGHT, half_width_px, line_px
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer, View
from fieldnav.simulation.sensor import Sensor
from fieldnav.simulation.shaking import Shaking

RowNumber = tuple[int, int]
"""Lane and row of the plan."""

FRAMES_PER_S = 15.0
BEHIND_M = (0.35, 0.5)  # from the camera back to the mean row end, where a switch takes place
MARKED_M = 0.01  # standard deviation of where either end of a row's line is marked
SWING_RAD, SWING_M = radians(1.5), 0.6  # the heading is held within this; it comes and goes over so much way


@dataclass(frozen=True, slots=True)
class RowsSeen:
    """One picture, where the robot was across the lanes, and the line of each row that shows."""

    image: Image
    right_m: float
    lines: Mapping[RowNumber, RowLine]


class RowEndScene:
    """A sown field under a camera that looks at its row ends; the calibration errs, the camera shakes."""

    def __init__(self, field: FieldSettings, crop: CropProfile, robot: Robot) -> None:
        errors = field.camera_errors
        self.camera = robot.cameras.front.pinhole()
        self.plan = sow(field, crop, Side.RIGHT)
        self._crop, self._exposure_s = crop, errors.exposure_s
        self._random = np.random.default_rng(field.seed)
        self._renderer = FieldRenderer(self.plan, field, crop)
        self._sensor = Sensor(errors, self.camera.width_px, self.camera.height_px, field.seed)
        self._shaking = Shaking(errors, field.seed, field.mirrored)
        self._hung = as_it_hangs(self.camera, errors, self._random.uniform(-1, 1, 3))
        self.along_m = float(self.plan.s_first_m.mean()) - self._random.uniform(*BEHIND_M)

    def pictures(self, right_m: Floats) -> Iterator[RowsSeen]:
        """Pictures on the way over places right of the first lane's middle, shape (n,), in their order."""
        speed_mps = self._crop.speeds.sidestep_mps
        phase = self._random.uniform(0, 2 * np.pi)
        smear_px = speed_mps * self._exposure_s * float(self.camera.pixels_per_metre(self.camera.centre_y_px))
        for place_m in right_m.tolist():
            time_s = abs(place_m - float(right_m[0])) / speed_mps
            heading_rad = SWING_RAD * np.sin(2 * np.pi * place_m / SWING_M + phase)
            view = self._view(place_m, float(heading_rad), time_s, speed_mps)
            plain = self._renderer.render(view, time_s)
            image = self._sensor.expose(plain, round(time_s * FRAMES_PER_S), (smear_px, 0.0))
            yield RowsSeen(image, place_m, self._lines(view))

    def _view(self, right_m: float, heading_rad: float, time_s: float, speed_mps: float) -> View:
        """The robot's centre lies behind its camera."""
        along_m = self.along_m - self.camera.forward_m
        place_m = self.plan.centreline.position(along_m, -right_m)
        return view_from(self._hung, place_m, heading_rad, self._shaking.at(time_s, speed_mps))

    def _lines(self, view: View) -> dict[RowNumber, RowLine]:
        """Lines of the rows that stand wholly within the upper half of the view, with a plant in it."""
        rows = np.ndindex(self.plan.lanes, self.plan.rows_per_lane)
        marked = {(lane, row): self._marked(view, lane, row) for lane, row in rows}
        return {
            number: line
            for number, line in marked.items()
            if row_stands_in(line, self._crop, self.camera) and self._has_plants(view, number)
        }

    def _marked(self, view: View, lane: int, row: int) -> RowLine:
        s = np.arange(self.along_m - REACH_M, self.along_m + REACH_M, POINT_STEP_M)
        points = self.plan.centreline.position(s, self.plan.rows.row_n(lane, row, s))
        height_m = VISIBLE_HEIGHT * self._crop.plants.canopy_height_m
        line = straight_line(seen_at(view, points, height_m), view.height_px)
        ends = np.array([0.0, view.height_px - 1.0])
        off = self._random.normal(0, MARKED_M, 2) * self.camera.pixels_per_metre(ends)
        return RowLine(line.x_top_px + float(off[0]), line.x_bottom_px + float(off[1]))

    def _has_plants(self, view: View, number: RowNumber) -> bool:
        plants = self.plan.plants
        own = plants.is_crop & (plants.lane == number[0]) & (plants.row == number[1])
        stems = np.stack([plants.x_m[own], plants.y_m[own]], axis=-1)
        y = seen_at(view, stems, VISIBLE_HEIGHT * self._crop.plants.canopy_height_m)[:, 1]
        return bool(((y >= 0) & (y <= self.camera.centre_y_px)).any())


def row_stands_in(line: RowLine, crop: CropProfile, camera: Pinhole) -> bool:
    """Whether a row's parallelogram lies within the upper half of the picture."""
    ends = np.array([0.0, camera.centre_y_px])
    middle, half = line_px(line, ends, camera), half_width_px(ends, crop, camera)
    return bool(((middle - half >= 0) & (middle + half <= camera.width_px - 1)).all())
