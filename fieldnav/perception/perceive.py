"""A fresh frame, seen for the first time: plants, rows, and the lane under the robot."""

from dataclasses import dataclass

from fieldnav.messages import Centres, Floats, Image, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.comb.search_range import range_of
from fieldnav.perception.finders import Shown, find_rows, in_whole
from fieldnav.perception.found import NO_ROWS, Found
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.lane import LaneFit, lane_rows
from fieldnav.perception.plants import plants_in
from fieldnav.perception.second_witness import BORNE_OUT, share_borne_out
from fieldnav.perception.settle import settle
from fieldnav.perception.vegetation import Cover, vegetation_of
from fieldnav.perception.witnessed import find_witnessed
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, RowFinder


@dataclass(frozen=True, slots=True)
class View:
    """What one frame shows.

    cover and centres: its vegetation and the plants; lines: every row it shows, left to right; paths_px: the
    same rows as curves, shape (rows, points, 2), x and y from the upper edge of the ground to the lower edge;
    lane: the rows under the robot, None when there are none; field: the probability that the picture shows a
    field of rows at all, None for a camera whose pose is known; borne_out: the share of the best row that
    the network bears out, 0 to 1, None where it was not asked.
    """

    cover: Cover
    centres: Centres
    lines: tuple[RowLine, ...]
    paths_px: Floats
    lane: LaneFit | None
    field: float | None = None
    borne_out: float | None = None

    @property
    def no_field(self) -> bool:
        """Whether vegetation shows rows that the network does not see: a verge, a hedge, something green."""
        return self.borne_out is not None and self.borne_out < BORNE_OUT


def find(
    image: Image,
    crop: CropProfile,
    camera: Pinhole,
    widest_offset_m: float | None = None,
    pose_known: bool = True,
) -> View:
    """Find the rows of a frame without knowing any before; see `lane_rows` for `widest_offset_m`.

    pose_known: whether the pose is that of the file but for calibration and shaking. If so, vegetation shows
    rows, and the network has to bear one of them out (`second_witness`). If not, they are what both show
    together (`witnessed`), unless the profile does without the network.
    """
    cover = vegetation_of(image, crop.vegetation, camera.top_px)
    centres = plants_in(cover, crop.vegetation, camera)
    field = None
    both = crop.finding.second_witness and crop.finding.method is RowFinder.COMB
    if pose_known or not both:
        found = find_rows(Shown(image, cover, centres), crop, camera, pose_known)
    else:
        plane = canopy_plane(camera, crop)
        tried = range_of(plane, crop.rows.spacing_m, pose_known)
        ground, top_px = cover.below(plane.top_px)
        witnessed = find_witnessed(image[int(top_px) :], ground, crop.vegetation, tried)
        found, field = in_whole(witnessed.found, ground.height_px, top_px), witnessed.field
    sure, borne_out = found.sure(), None
    lane = (
        _lane(found, centres, crop, camera, widest_offset_m) if pose_known or not both or sure.lines else None
    )
    if pose_known and crop.finding.second_witness and (lane or sure.lines):
        borne_out = share_borne_out(image, lane.rows if lane else sure.lines, crop, camera)
        if borne_out < BORNE_OUT:
            sure, lane = NO_ROWS, None
    return View(cover, centres, sure.lines, sure.paths_px, lane, field, borne_out)


def _lane(
    found: Found, centres: Centres, crop: CropProfile, camera: Pinhole, widest_offset_m: float | None
) -> LaneFit | None:
    plants = on_ground(centres, crop, camera)
    return settle(
        lane_rows(found.lines, crop, camera, widest_offset_m), plants, crop, camera, widest_offset_m
    )
