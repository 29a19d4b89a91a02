"""The passing rows as lines of the image, and which of them stand wholly in the view."""

import numpy as np

from fieldnav.messages import RowLine
from fieldnav.perception.canopy import canopy_plane, half_width_px, line_px
from fieldnav.perception.sidestep.passing_rows import Crossing, look_at_m
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile


def rows_in_image(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> tuple[RowLine, ...]:
    """All rows as lines of the image, left to right."""
    plane = canopy_plane(camera, crop)
    lines = (_line(crossing, row.across_m, plane) for row in crossing.rows)
    return tuple(sorted(lines, key=lambda line: line.x_bottom_px))


def row_in_view(crossing: Crossing, across_m: float, crop: CropProfile, camera: Pinhole) -> RowLine | None:
    """The line of a row at this distance from the robot, if its far half stands wholly in the view."""
    plane = canopy_plane(camera, crop)
    line = _line(crossing, across_m, plane)
    at = np.array([plane.top_px, plane.ground_middle_px])
    room, half = line_px(line, at, camera), half_width_px(at, crop, camera)
    inside = (room - half >= 0) & (room + half <= camera.width_px - 1)
    return line if inside.all() else None


def view_limit_m(crop: CropProfile, camera: Pinhole) -> float:
    """Distance to either side up to which a row along the view stands wholly in its far half."""
    plane = canopy_plane(camera, crop)
    at = np.array([plane.ground_middle_px])
    half_px = camera.centre_x_px - float(half_width_px(at, crop, camera)[0])
    return half_px / float(plane.pixels_per_metre(plane.ground_middle_px))


def _line(crossing: Crossing, across_m: float, plane: Pinhole) -> RowLine:
    offset_m = crossing.outward * across_m - crossing.slope * look_at_m(plane)
    return plane.row_in_image(offset_m, crossing.slope)
