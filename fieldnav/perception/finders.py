"""The row finders that a crop profile can choose between, behind one small interface."""

from collections.abc import Callable, Mapping
from dataclasses import replace

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
    y = np.array([camera.top_px, camera.height_px - 1.0])
    paths = [np.stack([line_px(line, y, camera), y], axis=-1) for line in lines]
    return Found(lines, np.array(paths).reshape(len(lines), len(y), 2))


def _fitting(crop: CropProfile, camera: Pinhole) -> Finding:
    """The profile's window and stride, smaller where rows stand so close that two would share one."""
    plane = canopy_plane(camera, crop)
    spacing_px = crop.rows.spacing_m * float(plane.pixels_per_metre(camera.ground_middle_px))
    share = min(1.0, NARROWER * spacing_px / camera.width_px / crop.finding.window)
    changes = {"window": share * crop.finding.window, "stride": share * crop.finding.stride}
    return crop.finding.model_copy(update=changes)


def _by_comb(cover: Cover, centres: Centres, crop: CropProfile, camera: Pinhole, pose_known: bool) -> Found:
    plane = canopy_plane(camera, crop)
    tried = range_of(plane, crop.rows.spacing_m, pose_known)
    ground, top_px = cover.below(plane.top_px)
    found = find_comb(ground, tried)
    return in_whole(rows_in(*found, ground), ground.height_px, top_px) if found else NO_ROWS


def in_whole(found: Found, height_px: int, top_px: float) -> Found:
    """The rows of the lower part of an image, so high, as those of the whole: lines are carried on up."""
    if not top_px:
        return found
    higher = (height_px - 1 + top_px) / (height_px - 1)
    lines = tuple(
        replace(line, x_top_px=line.x_bottom_px + (line.x_top_px - line.x_bottom_px) * higher)
        for line in found.lines
    )
    return Found(lines, found.paths_px + np.array([0.0, top_px]))


_FINDERS: Mapping[RowFinder, Callable[[Cover, Centres, CropProfile, Pinhole, bool], Found]] = {
    RowFinder.MOVING_VARIANCE: _by_moving_variance,
    RowFinder.COMB: _by_comb,
}
