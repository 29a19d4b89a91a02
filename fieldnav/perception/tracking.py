"""The lane's rows from one frame to the next: a parallelogram on each (paper III-A.3)."""

from dataclasses import dataclass
from math import atan2, tan

import numpy as np

from fieldnav.messages import Centres, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import comb_of, follow
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.lane import LaneFit
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile


@dataclass(frozen=True, slots=True)
class TrackedRows:
    """The lane's rows as last seen, left to right; a row not seen in the last frame has confidence 0."""

    rows: tuple[RowLine, ...]
    stamp_s: float

    @property
    def rows_seen(self) -> int:
        """How many rows the last frame showed."""
        return sum(row.confidence > 0 for row in self.rows)


@dataclass(frozen=True, slots=True)
class Feature:
    """The average line of the lane's rows (paper III-B).

    offset_px: where it meets the image's bottom edge, to the right of the centre; theta_rad: its angle from
    the image's vertical, positive clockwise, so when it leans to the right towards the top.
    """

    offset_px: float
    theta_rad: float

    def line(self, width_px: int, height_px: int) -> RowLine:
        """The line in an image of that size."""
        bottom_px = (width_px - 1) / 2 + self.offset_px
        return RowLine(bottom_px + tan(self.theta_rad) * (height_px - 1), bottom_px)


def start(fit: LaneFit, stamp_s: float) -> TrackedRows:
    """Begin to track the lane found at `stamp_s`."""
    return TrackedRows(fit.rows, stamp_s)


def track(
    rows: TrackedRows, centres: Centres, stamp_s: float, crop: CropProfile, camera: Pinhole
) -> TrackedRows:
    """Move the rows to where the plants of a new frame show them.

    A row with fewer plants in its parallelogram than the profile asks for counts as not seen and goes along
    with the others; so does one that has drifted off its place between them, which is put back.
    """
    plane = canopy_plane(camera, crop)
    followed = follow(comb_of(rows.rows, crop, plane), on_ground(centres, crop, camera), crop)
    return TrackedRows(followed.comb.in_image(followed.confidence, plane), stamp_s)


def feature(rows: tuple[RowLine, ...], camera: Pinhole) -> Feature:
    """The average line of the lane's rows, those not seen included: without them it would jump sideways."""
    bottom = float(np.mean([row.x_bottom_px for row in rows]))
    top = float(np.mean([row.x_top_px for row in rows]))
    return Feature(bottom - camera.centre_x_px, atan2(top - bottom, camera.height_px - 1))
