"""Where a camera truly hangs over a rendered field, and where the rows run in its picture."""

from dataclasses import replace
from math import cos, radians, sin

import numpy as np

from fieldnav.messages import Floats, RowLine
from fieldnav.pinhole import Pinhole
from fieldnav.settings.field import CameraErrors
from fieldnav.simulation.renderer import View
from fieldnav.simulation.shaking import Attitude, rotation

REACH_M = 3.0  # a picture shows no ground further from the robot's centre
POINT_STEP_M = 0.02  # between the points of a true row
NEAREST_M = 0.1  # along the camera's axis; what lies behind the lens has no place in the picture


def as_it_hangs(camera: Pinhole, errors: CameraErrors, drawn: Floats) -> Pinhole:
    """The camera where its calibration errs by drawn shares, -1 to 1, shape (3,), of the most it may."""
    tilt, height, focal = drawn.tolist()
    return replace(
        camera,
        tilt_rad=camera.tilt_rad + radians(errors.tilt_error_deg) * tilt,
        height_m=camera.height_m + errors.height_error_m * height,
        focal_px=camera.focal_px * (1 + errors.focal_error * focal),
    )


def view_from(camera: Pinhole, place_m: Floats, heading_rad: float, attitude: Attitude) -> View:
    """What a front camera sees, robot at place_m, shape (2,), of the field; its pose true."""
    ahead_m = camera.forward_m
    x = place_m[0] + ahead_m * cos(heading_rad)
    y = place_m[1] + ahead_m * sin(heading_rad)
    z = camera.height_m + attitude.height_m - ahead_m * sin(attitude.pitch_rad)
    turned = rotation(attitude, 1, heading_rad, camera.tilt_rad)
    return View(camera.width_px, camera.height_px, camera.focal_px, np.array([x, y, z]), turned)


def seen_at(view: View, ground_m: Floats, height_m: float) -> Floats:
    """Pixels, shape (k, 2), of those points over world places, shape (n, 2), that lie before the lens."""
    point = np.column_stack([ground_m, np.full(len(ground_m), height_m)]) - view.position_m
    x, y, depth = view.projection @ point.T
    before = depth > NEAREST_M
    return np.stack([x[before] / depth[before], y[before] / depth[before]], axis=-1)


def in_picture(point_px: Floats, view: View) -> int:
    """How many pixels, shape (n, 2), lie within the picture."""
    last = np.array([view.width_px - 1, view.height_px - 1])
    return int(((point_px >= 0) & (point_px <= last)).all(axis=1).sum())


def straight_line(point_px: Floats, height_px: int) -> RowLine:
    """The straight line that fits a curve of pixels, shape (n, 2), best over the picture's height."""
    order = np.argsort(point_px[:, 1])
    y = np.arange(height_px)
    x = np.interp(y, point_px[order, 1], point_px[order, 0])
    slope, top_px = np.polyfit(y, x, 1)
    return RowLine(float(top_px), float(top_px + slope * (height_px - 1)))
