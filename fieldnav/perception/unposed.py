"""Rows in a picture whose camera nobody knows: the perspective is found together with the rows."""

from dataclasses import dataclass
from math import atan, sin

from fieldnav.messages import Image
from fieldnav.perception.comb.candidates import Candidate
from fieldnav.perception.comb.search_range import any_camera
from fieldnav.perception.finders import Shown, find_rows
from fieldnav.perception.found import NO_ROWS
from fieldnav.perception.perceive import View
from fieldnav.perception.plants import NO_PLANTS, plants_in
from fieldnav.perception.vegetation import Cover, vegetation_of
from fieldnav.perception.witnessed import find_witnessed
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
    spacing_m = crop.rows.spacing_m if crop else None
    cover = vegetation_of(image, vegetation)
    witnessed = find_witnessed(image, cover, vegetation, any_camera(spacing_m))
    found = witnessed.found.sure()
    if not witnessed.candidate or not found.lines:
        return Unposed(View(cover, NO_PLANTS, (), NO_ROWS.paths_px, None, witnessed.field), None)
    camera = _camera_of(witnessed.candidate, cover, spacing_m or SPACING_M)
    centres = plants_in(cover, vegetation, camera)
    if crop is not None and crop.finding.method is not RowFinder.COMB:
        found = find_rows(Shown(image, cover, centres), crop, camera).sure()
    view = View(cover, centres, found.lines, found.paths_px, None, witnessed.field)
    return Unposed(view, camera)


def _camera_of(candidate: Candidate, cover: Cover, spacing_m: float) -> Pinhole:
    focal_px = FOCAL * cover.width_px
    convergence = max(candidate.convergence, LEAST_CONVERGENCE)
    tilt_rad = atan(cover.height_px / convergence / focal_px)
    spacing_px = cover.width_px / candidate.rows_across
    height_m = focal_px * sin(tilt_rad) * spacing_m / spacing_px
    return Pinhole(cover.width_px, cover.height_px, focal_px, height_m, tilt_rad, 0.0)
