"""How a crop is sown as a frame shows it, measured on the ground by where the robot file has the camera."""

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.canopy import canopy_plane, line_px
from fieldnav.perception.perceive import View
from fieldnav.perception.plants import to_full
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

FEWEST_ROWS = 2
BIN_M = 0.01
EDGE = 0.15
"""Of the cover on the row's middle: where a canopy ends. Rendered crops then measure 0.75 to 1.1 of their
profile's width; half the cover would measure the plants' hearts."""
LEAST_COVER = 0.1
"""On the rows' middle; of less no width can be told."""


def spacing_m(view: View, crop: CropProfile, camera: Pinhole) -> float | None:
    """Median distance between neighbouring rows in the middle of the view; None with fewer than two."""
    if len(view.lines) < FEWEST_ROWS:
        return None
    plane = canopy_plane(camera, crop)
    offset, slope = np.array([plane.row_on_ground(line) for line in view.lines]).T
    place = np.sort(offset + slope * sum(plane.view_m) / 2)
    return float(np.median(np.diff(place)))


def canopy_width_m(view: View, crop: CropProfile, camera: Pinhole) -> float | None:
    """How wide the vegetation along the rows found is; None where it is too thin or closed to tell."""
    if not view.lines:
        return None
    cover = _cover_across(view, crop, camera)
    least, most = float(cover.min()), float(cover[: len(cover) // 4 + 1].max())
    outside = np.flatnonzero(cover < least + EDGE * (most - least))
    if most - least < LEAST_COVER or not len(outside):
        return None
    return 2 * BIN_M * float(outside[0])


def _cover_across(view: View, crop: CropProfile, camera: Pinhole) -> Floats:
    """Share of the ground that is green, by distance from the nearest row in steps of BIN_M, shape (n,)."""
    height, width = view.cover.index.shape
    green = view.cover.mask[view.cover.top :] > 0
    y = to_full(np.arange(view.cover.top, height, dtype=float), view.cover.height_px / height)
    x = to_full(np.arange(width, dtype=float), view.cover.width_px / width)
    across = canopy_plane(camera, crop).pixels_per_metre(y)[:, None]
    off_px = [np.abs(x - line_px(line, y, camera)[:, None]) for line in view.lines]
    nearest_m = np.minimum.reduce(off_px) / across
    bins = int(crop.rows.spacing_m / 2 / BIN_M)
    number = np.minimum((nearest_m / BIN_M).astype(np.int64), bins).ravel()
    # A pixel further away shows more of the ground.
    ground = np.broadcast_to(across**-2.0, green.shape)
    whole = np.bincount(number, ground.ravel(), bins + 1)[:bins]
    covered = np.bincount(number, (ground * green).ravel(), bins + 1)[:bins]
    return np.asarray(np.divide(covered, whole, out=np.zeros(bins), where=whole > 0))
