"""The row finders that a crop profile can choose between, behind one small interface."""

from collections.abc import Callable, Mapping

import numpy as np

from fieldnav.messages import Centres
from fieldnav.perception import moving_variance
from fieldnav.perception.canopy import canopy_plane, line_px
from fieldnav.perception.comb.finder import find_comb, rows_in
from fieldnav.perception.comb.search_range import range_of
from fieldnav.perception.found import NO_ROWS, Found
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.settle import settle_lines
from fieldnav.perception.vegetation import Cover
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, Finding, RowFinder

NARROWER = 0.5  # a window against the distance between rows at mid-height, at most


def find_rows(
    cover: Cover, centres: Centres, crop: CropProfile, camera: Pinhole, pose_known: bool = True
) -> Found:
    """The rows of a frame by the method that the profile names; see `perceive.find`."""
    return _FINDERS[crop.finding.method](cover, centres, crop, camera, pose_known)


def _by_moving_variance(
    cover: Cover, centres: Centres, crop: CropProfile, camera: Pinhole, pose_known: bool
) -> Found:
    lines = moving_variance.find_rows(centres, _fitting(crop, camera), camera)
    lines = settle_lines(lines, on_ground(centres, crop, camera), crop, camera)
    y = np.array([0.0, camera.height_px - 1.0])
    paths = [np.stack([line_px(line, y, camera), y], axis=-1) for line in lines]
    return Found(lines, np.array(paths).reshape(len(lines), len(y), 2))


def _fitting(crop: CropProfile, camera: Pinhole) -> Finding:
    """The profile's window and stride, smaller where rows stand so close that two would share one."""
    spacing_px = crop.rows.spacing_m * float(canopy_plane(camera, crop).pixels_per_metre(camera.centre_y_px))
    share = min(1.0, NARROWER * spacing_px / camera.width_px / crop.finding.window)
    changes = {"window": share * crop.finding.window, "stride": share * crop.finding.stride}
    return crop.finding.model_copy(update=changes)


def _by_comb(cover: Cover, centres: Centres, crop: CropProfile, camera: Pinhole, pose_known: bool) -> Found:
    found = find_comb(cover, range_of(canopy_plane(camera, crop), crop.rows.spacing_m, pose_known))
    return rows_in(*found, cover) if found else NO_ROWS


_FINDERS: Mapping[RowFinder, Callable[[Cover, Centres, CropProfile, Pinhole, bool], Found]] = {
    RowFinder.MOVING_VARIANCE: _by_moving_variance,
    RowFinder.COMB: _by_comb,
}
