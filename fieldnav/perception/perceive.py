"""A fresh frame, seen for the first time: plants, rows, and the lane under the robot."""

from dataclasses import dataclass

from fieldnav.messages import Centres, Image, RowLine
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.lane import LaneFit, lane_rows
from fieldnav.perception.moving_variance import FieldStructure, field_structure, find_rows, rows_of
from fieldnav.perception.settle import settle, settle_lines
from fieldnav.perception.vegetation import Mask, find_plants
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile


@dataclass(frozen=True, slots=True)
class View:
    """What one frame shows.

    centres and mask: the plants; structure: the field-structure signal; lines: every row it shows, left to
    right, fitted once more to the plants along it; lane: the rows under the robot, fitted likewise, None when
    there are none.
    """

    centres: Centres
    mask: Mask
    structure: FieldStructure
    lines: tuple[RowLine, ...]
    lane: LaneFit | None


def find(image: Image, crop: CropProfile, camera: Pinhole, widest_offset_m: float | None = None) -> View:
    """Find the rows of a frame without knowing any before; see `lane_rows` for `widest_offset_m`."""
    centres, mask = find_plants(image, crop.vegetation, camera)
    structure = field_structure(centres, crop.finding, camera)
    lines = rows_of(structure, crop.finding, camera)
    plants = on_ground(centres, crop, camera)
    lane = settle(lane_rows(lines, crop, camera, widest_offset_m), plants, crop, camera, widest_offset_m)
    heading = None if lane is None else lane.slope
    return View(centres, mask, structure, settle_lines(lines, heading, plants, crop, camera), lane)


def lane_of(
    centres: Centres, crop: CropProfile, camera: Pinhole, widest_offset_m: float | None = None
) -> LaneFit | None:
    """The lane under the robot among plants already found; None when there is none."""
    lines = find_rows(centres, crop.finding, camera)
    plants = on_ground(centres, crop, camera)
    return settle(lane_rows(lines, crop, camera, widest_offset_m), plants, crop, camera, widest_offset_m)
