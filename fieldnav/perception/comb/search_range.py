"""Which combs are looked for: as wide as what is not known of the camera, the rows and the heading."""

from functools import lru_cache
from math import cos, radians, tan

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.comb.periodogram import FEWEST_ROWS_ACROSS, SearchRange
from fieldnav.pinhole import Pinhole

MOST_ROWS_ACROSS = 24.0
STEEPEST = tan(radians(14))  # of the rows against the camera's axis
IN_STEP = 0.25  # cycles: neighbouring places of the search differ by less at the picture's edge
NEAREST = 0.2  # how far the ground's scale departs from that at mid-height within a steep view, about
FEWEST_STEPS = 3

TILT_ERROR_RAD = radians(4)  # calibration and shaking
SCALE_ERROR = 0.15  # of height, focal length and row spacing together

UNKNOWN_TILT_RAD = radians(8)
UNKNOWN_SCALE = 2.2  # times, either way: a camera said to be one metre up may be at two

LOWEST_M, HIGHEST_M = 0.5, 3.0  # a camera that nothing is known of
VIEW = 0.65  # usual focal length over the picture's width, times the sine of a usual tilt
STEEP = np.arange(0.2, 0.66, 0.05)  # convergence of cameras that look down
OBLIQUE = np.concatenate([np.arange(0.7, 1.2, 0.1), np.arange(1.2, 2.2, 0.05)])
VANISHING = np.arange(-0.5, 0.51, 0.05)
BENDS = np.array([-0.15, -0.05, 0.0, 0.05, 0.15])
CANDIDATES = 6


@lru_cache(maxsize=8)
def range_of(plane: Pinhole, spacing_m: float, pose_known: bool) -> SearchRange:
    """The range for a camera over the canopy's plane; kept for the frames that follow.

    Heights of the comb are those of the ground in the image, from the plane's `top_px` on down.

    pose_known: whether the camera's pose is that of its file but for calibration and shaking; otherwise it
    may be quite another one.
    """
    tilt, scale = (TILT_ERROR_RAD, 1 + SCALE_ERROR) if pose_known else (UNKNOWN_TILT_RAD, UNKNOWN_SCALE)
    across = plane.width_px / float(plane.pixels_per_metre(plane.ground_middle_px)) / spacing_m
    most = STEEPEST * plane.focal_px / (plane.width_px * cos(plane.tilt_rad))
    rows_across = _rows_across(across / scale, across * scale)
    leans = _steps(-most, most, IN_STEP / float(rows_across.max()) / NEAREST)
    tilts = plane.tilt_rad + tilt * np.linspace(-1, 1, FEWEST_STEPS if pose_known else 2 * FEWEST_STEPS + 1)
    below_axis_px = plane.ground_middle_px - plane.centre_y_px
    convergence = (plane.height_px - plane.top_px) / (plane.focal_px * np.tan(tilts) + below_axis_px)
    followed, refined = (2, 1) if pose_known else (CANDIDATES, CANDIDATES)
    return SearchRange(
        np.abs(convergence), rows_across, leans, np.zeros(1), followed, not pose_known, refined
    )


@lru_cache(maxsize=2)
def any_camera(spacing_m: float | None) -> SearchRange:
    """The range for a camera that nothing is known of, and rows whose spacing may not be known either."""
    fewest, most = FEWEST_ROWS_ACROSS, MOST_ROWS_ACROSS
    if spacing_m is not None:
        fewest, most = (height / (VIEW * spacing_m) for height in (LOWEST_M, HIGHEST_M))
    rows_across = _rows_across(fewest, most)
    return SearchRange(
        np.concatenate([STEEP, OBLIQUE]), rows_across, VANISHING, BENDS, CANDIDATES, True, CANDIDATES
    )


def _rows_across(fewest: float, most: float) -> Floats:
    low, high = max(fewest, FEWEST_ROWS_ACROSS), min(max(most, FEWEST_ROWS_ACROSS), MOST_ROWS_ACROSS)
    return _steps(min(low, high), high, IN_STEP)


def _steps(first: float, last: float, step: float) -> Floats:
    return np.linspace(first, last, max(FEWEST_STEPS, round((last - first) / step) + 1))
