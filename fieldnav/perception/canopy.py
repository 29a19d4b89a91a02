"""Where a crop is seen: the plane through its canopy, and the parallelogram on a row (paper III-A.3)."""

from dataclasses import replace
from math import cos

import numpy as np

from fieldnav.messages import Floats, RowLine
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

VISIBLE_HEIGHT = 0.5  # of the canopy's height: where the centre of mass of what a camera sees of a plant lies
LOWEST_CAMERA_M = 0.1  # above that plane
MIN_SPACING_PX = 6.0
"""Of the image, that a row spacing must cover for the ground there to count: three for a row, three for the
ground beside it. Only small images come to it: 640 pixels across have 28 ten degrees below the horizon."""


def canopy_plane(camera: Pinhole, crop: CropProfile) -> Pinhole:
    """The camera over the plane through the middle of the canopy instead of the ground.

    Seen from one metre, a plant of 0.3 m lies nearer by a sixth than the ground it stands on.
    """
    height_m = camera.height_m - VISIBLE_HEIGHT * crop.plants.canopy_height_m
    plane = replace(camera, height_m=max(height_m, LOWEST_CAMERA_M))
    return replace(plane, top_px=_rows_from_px(plane, crop)) if plane.top_px else plane


def _rows_from_px(plane: Pinhole, crop: CropProfile) -> float:
    """The image row from which on down rows can be told apart; half of the ground is left in any case."""
    spacing_per_px = crop.rows.spacing_m * cos(plane.tilt_rad) / plane.height_m  # below the horizon
    return min(max(plane.top_px, plane.horizon_px + MIN_SPACING_PX / spacing_per_px), plane.ground_middle_px)


def half_width_px(y_px: Floats, crop: CropProfile, camera: Pinhole) -> Floats:
    """Half the width of a row's parallelogram at image rows: the canopy's, at least the profile's share."""
    across = canopy_plane(camera, crop).pixels_per_metre(y_px)
    narrowest = crop.tracking.narrowest * camera.width_px
    return np.asarray(np.maximum(crop.plants.canopy_width_m * across, narrowest) / 2)


def line_px(row: RowLine, y_px: Floats, camera: Pinhole) -> Floats:
    """Where a row's line lies at image rows."""
    return np.asarray(row.x_top_px + (row.x_bottom_px - row.x_top_px) * y_px / (camera.height_px - 1))
