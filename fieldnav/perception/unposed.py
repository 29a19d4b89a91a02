"""Rows in a picture whose camera nobody knows: the perspective is found together with the rows."""

from dataclasses import dataclass
from math import atan, sin

import numpy as np

from fieldnav.messages import Image
from fieldnav.perception.comb.bands import LEVEL
from fieldnav.perception.comb.finder import convergence_of, find_comb, rows_in
from fieldnav.perception.comb.row_comb import RowComb
from fieldnav.perception.comb.search_range import any_camera
from fieldnav.perception.finders import find_rows
from fieldnav.perception.found import NO_ROWS
from fieldnav.perception.perceive import View
from fieldnav.perception.plants import NO_PLANTS, plants_in
from fieldnav.perception.vegetation import Cover, vegetation_of
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, RowFinder, Vegetation

FOCAL = 0.75  # assumed focal length over the picture's width; one picture of a plane does not tell it
SPACING_M = 0.5  # assumed row spacing of a crop that is not known
LEAST_CONVERGENCE = 0.05


@dataclass(frozen=True, slots=True)
class Unposed:
    """What a picture shows, and the camera that it must have been taken with.

    camera: None when no rows told of it. Its focal length is assumed; tilt and height follow from it and from
    how the rows run together, `crop` giving their spacing.
    """

    view: View
    camera: Pinhole | None


def find_unposed(image: Image, crop: CropProfile | None) -> Unposed:
    """Find the rows of a picture of an unknown camera, of a crop that may be unknown."""
    vegetation = crop.vegetation if crop else Vegetation()
    cover = vegetation_of(image, vegetation)
    combed = find_comb(cover, any_camera(crop.rows.spacing_m if crop else None))
    found = rows_in(*combed, cover).sure() if combed else NO_ROWS
    if not combed or not found.lines:
        return Unposed(View(cover, NO_PLANTS, (), NO_ROWS.paths_px, None), None)
    camera = _camera_of(combed[0], cover, crop.rows.spacing_m if crop else SPACING_M)
    centres = plants_in(cover, vegetation, camera)
    if crop is not None and crop.finding.method is not RowFinder.COMB:
        found = find_rows(cover, centres, crop, camera).sure()
    return Unposed(View(cover, centres, found.lines, found.paths_px, None), camera)


def _camera_of(comb: RowComb, cover: Cover, spacing_m: float) -> Pinhole:
    focal_px = FOCAL * cover.width_px
    convergence = max(convergence_of(comb), LEAST_CONVERGENCE)
    tilt_rad = atan(cover.height_px / convergence / focal_px)
    spacing_px = float(np.interp(0.0, LEVEL, comb.spacing)) * cover.width_px
    height_m = focal_px * sin(tilt_rad) * spacing_m / spacing_px
    return Pinhole(cover.width_px, cover.height_px, focal_px, height_m, tilt_rad, 0.0)
