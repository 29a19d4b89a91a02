"""The row finders that a crop profile can choose between, behind one small interface."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from fieldnav.messages import Centres, Floats, Image
from fieldnav.perception import moving_variance
from fieldnav.perception.canopy import canopy_plane, line_px
from fieldnav.perception.comb.bands import Bands, bands_of
from fieldnav.perception.comb.evidence import network_bands
from fieldnav.perception.comb.finder import find_comb, rows_in
from fieldnav.perception.comb.search_range import range_of
from fieldnav.perception.found import NO_ROWS, Found
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.row_network import look
from fieldnav.perception.settle import settle_lines
from fieldnav.perception.vegetation import Cover, as_colour
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, Finding, RowFinder

NARROWER = 0.5  # a window against the distance between rows at mid-height, at most

PLAINLY = 0.5  # mean probability along a row that the network sees plainly


@dataclass(frozen=True, slots=True)
class Shown:
    """What the finders look at: an image, its vegetation, and the plants in it."""

    image: Image
    cover: Cover
    centres: Centres


def find_rows(shown: Shown, crop: CropProfile, camera: Pinhole, pose_known: bool = True) -> Found:
    """The rows of a frame by the method that the profile names; see `perceive.find`."""
    return _FINDERS[crop.finding.method](shown, crop, camera, pose_known)


def _by_moving_variance(shown: Shown, crop: CropProfile, camera: Pinhole, pose_known: bool) -> Found:
    centres = shown.centres
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


def _by_comb(shown: Shown, crop: CropProfile, camera: Pinhole, pose_known: bool) -> Found:
    """The comb that fits the vegetation best."""
    plane = canopy_plane(camera, crop)
    ground, top_px = shown.cover.below(plane.top_px)
    found = _fitted(bands_of(ground.strength), ground, crop, plane, pose_known)
    return in_whole(found, ground.height_px, top_px)


def _by_network(shown: Shown, crop: CropProfile, camera: Pinhole, pose_known: bool) -> Found:
    """The comb that fits best what the network sees; a row that it hardly sees is none."""
    plane, colour = canopy_plane(camera, crop), as_colour(shown.image)
    if colour is None:
        return NO_ROWS
    ground, top_px = shown.cover.below(plane.top_px)
    bands = network_bands(look(colour[int(top_px) :]))
    found = _fitted(bands, ground, crop, plane, pose_known)
    if not found.lines:
        return NO_ROWS
    sure = np.minimum(_mean_heat(found, bands, ground.width_px) / PLAINLY, 1)
    lines = [
        replace(line, confidence=line.confidence * float(share))
        for line, share in zip(found.lines, sure, strict=True)
    ]
    return in_whole(replace(found, lines=tuple(lines)), ground.height_px, top_px)


def _fitted(bands: Bands, ground: Cover, crop: CropProfile, plane: Pinhole, pose_known: bool) -> Found:
    """The rows of the comb that fits the bands best."""
    comb = find_comb(bands, range_of(plane, crop.rows.spacing_m, pose_known))
    return rows_in(comb, bands, ground) if comb else NO_ROWS


def _mean_heat(found: Found, bands: Bands, width_px: int) -> Floats:
    """The network's mean probability along each row's curve, shape (rows,)."""
    place = (found.paths_px[:, 1:-1, 0] - (width_px - 1) / 2) / width_px
    value, inside = bands.sample(place[:, :, None])
    return np.asarray(value.sum(axis=(1, 2)) / np.maximum(inside.sum(axis=(1, 2)), 1))


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


_FINDERS: Mapping[RowFinder, Callable[[Shown, CropProfile, Pinhole, bool], Found]] = {
    RowFinder.MOVING_VARIANCE: _by_moving_variance,
    RowFinder.COMB: _by_comb,
    RowFinder.NETWORK: _by_network,
}
