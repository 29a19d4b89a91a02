"""The rows that pass sideways, numbered from the lane the robot leaves, and their lines in the image (III-C).

Rows are held as distances `across_m` from the robot, measured on the ground at one image row in the middle of
the upper half, where the row ends are still seen; positive towards the side the robot moves to.
"""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import RowLine
from fieldnav.perception.canopy import canopy_plane, half_width_px, line_px
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

LOOK_AT = 0.25
"""The image row at which rows are placed, over the image's height."""
FIRST_SLOPE = 0.05
"""Standard deviation of the heading that the lane's rows gave; single looks err by several degrees."""


@dataclass(frozen=True, slots=True)
class PassingRow:
    """One row; number 0 is the outermost row of the old lane, 1 the first new row, -1 the old lane's next."""

    number: int
    across_m: float


@dataclass(frozen=True, slots=True)
class Crossing:
    """The rows known, their common slope on the ground, and the candidate for a new row.

    outward: +1 when the robot moves to the left of the camera's view, -1 when to the right.
    """

    outward: int
    rows: tuple[PassingRow, ...]
    slope: float
    slope_variance: float = FIRST_SLOPE**2
    candidate_m: float | None = None
    candidate_frames: int = 0
    usual_mass: float = 0.0
    """Whole plants that a row shows here, as the rows known so far show them."""

    @property
    def outermost(self) -> PassingRow:
        return max(self.rows, key=lambda row: row.number)

    @property
    def passed(self) -> int:
        """How many new rows have come."""
        return self.outermost.number


def begin(rows: tuple[RowLine, ...], outward: int, crop: CropProfile, camera: Pinhole) -> Crossing:
    """Start from the rows of the lane that the robot leaves."""
    plane = canopy_plane(camera, crop)
    across = sorted((_across_m(row, outward, plane) for row in rows), reverse=True)
    slope = float(np.mean([plane.row_on_ground(row)[1] for row in rows]))
    return Crossing(outward, tuple(PassingRow(-index, place) for index, place in enumerate(across)), slope)


def rows_in_image(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> tuple[RowLine, ...]:
    """The known rows as lines of the image, left to right."""
    plane = canopy_plane(camera, crop)
    lines = (_line(crossing, row.across_m, plane) for row in crossing.rows)
    return tuple(sorted(lines, key=lambda line: line.x_bottom_px))


def candidate_row(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> RowLine | None:
    """The candidate's line, once enough frames have shown it and it stands wholly in the view."""
    if crossing.candidate_m is None or crossing.candidate_frames < crop.recognition.confirm_frames:
        return None
    return row_in_view(crossing, crossing.candidate_m, crop, camera)


def outermost_row(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> RowLine | None:
    """The outermost known row's line, if it stands wholly in the view."""
    return row_in_view(crossing, crossing.outermost.across_m, crop, camera)


def row_in_view(crossing: Crossing, across_m: float, crop: CropProfile, camera: Pinhole) -> RowLine | None:
    """The line of a row at this distance from the robot, if the row stands wholly in the view."""
    line = _line(crossing, across_m, canopy_plane(camera, crop))
    at = np.array([0.0, camera.centre_y_px])
    room = line_px(line, at, camera), half_width_px(at, crop, camera)
    inside = (room[0] - room[1] >= 0) & (room[0] + room[1] <= camera.width_px - 1)
    return line if inside.all() else None


def look_at_m(plane: Pinhole) -> float:
    """Distance ahead of the robot's centre at which rows are placed."""
    at = np.array([plane.centre_x_px, LOOK_AT * plane.height_px])
    return float(plane.to_ground(at)[0])


def _across_m(row: RowLine, outward: int, plane: Pinhole) -> float:
    offset_m, slope = plane.row_on_ground(row)
    return outward * (offset_m + slope * look_at_m(plane))


def _line(crossing: Crossing, across_m: float, plane: Pinhole) -> RowLine:
    offset_m = crossing.outward * across_m - crossing.slope * look_at_m(plane)
    return plane.row_in_image(offset_m, crossing.slope)
