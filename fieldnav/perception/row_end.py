"""Which plants belong to the lane's rows, and how far ahead the rows reach (paper III-A.3)."""

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Centres, Floats, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import comb_of, widest_m
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.ground_rows import members
from fieldnav.perception.image_halves import ImagePart, lies_in
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile


def centres_in_rows(
    centres: Centres,
    rows: tuple[RowLine, ...],
    crop: CropProfile,
    camera: Pinhole,
    part: ImagePart = ImagePart.WHOLE,
) -> NDArray[np.bool_]:
    """Which plants have their centre in a row's parallelogram and in that part of the image; shape (n,)."""
    comb = comb_of(rows, crop, canopy_plane(camera, crop))
    belongs = members(comb, on_ground(centres, crop, camera), widest_m(crop)) >= 0
    return np.asarray(belongs & lies_in(centres, camera, part))


def crop_in_rows(
    centres: Centres, rows: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole, part: ImagePart
) -> float:
    """How much crop stands in the rows in that part of the image; 1 is one row without a gap.

    Each region counts by its area, so that small weeds in line with the rows do not pass for crop.
    """
    belongs = centres_in_rows(centres, rows, crop, camera, part)
    plants = float(on_ground(centres, crop, camera).weight[belongs].sum())
    edges = np.array([[camera.centre_x_px, 0.0], [camera.centre_x_px, camera.centre_y_px]])
    far_m, middle_m = canopy_plane(camera, crop).to_ground(edges)[:, 0]
    near_m, _ = canopy_plane(camera, crop).view_m
    length_m = {ImagePart.TOP: far_m - middle_m, ImagePart.BOTTOM: middle_m - near_m}.get(
        part, far_m - near_m
    )
    return plants * crop.plants.spacing_m / float(length_m)


def crop_stretch_m(
    centres: Centres, rows: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole
) -> tuple[float, float] | None:
    """Distance from the robot's centre to the nearest and the farthest plant of the rows; None without any.

    In the direction the camera looks.
    """
    ahead = _ahead_m(centres, rows, crop, camera)
    return (float(ahead.min()), float(ahead.max())) if len(ahead) else None


def nearest_crop_m(
    centres: Centres, rows: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole
) -> float | None:
    """Distance from the robot's centre to the nearest plant of the rows; None without any."""
    stretch = crop_stretch_m(centres, rows, crop, camera)
    return None if stretch is None else stretch[0]


def farthest_crop_m(
    centres: Centres, rows: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole
) -> float | None:
    """Distance from the robot's centre to the farthest plant of the rows; None without any."""
    stretch = crop_stretch_m(centres, rows, crop, camera)
    return None if stretch is None else stretch[1]


def _ahead_m(centres: Centres, rows: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole) -> Floats:
    belongs = centres_in_rows(centres, rows, crop, camera)
    return np.asarray(canopy_plane(camera, crop).to_ground(centres.position_px[belongs])[:, 0])
