"""The lane's rows from one frame to the next: a parallelogram on each (paper III-A.3)."""

from dataclasses import dataclass
from math import atan2

import numpy as np

from fieldnav.messages import Centres, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import comb_of, follow
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.lane import LaneFit
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, Tracking

DEFAULT_HOLD_S = float(Tracking().hold_s)


@dataclass(frozen=True, slots=True)
class TrackedRows:
    """The lane's rows as last seen, left to right; a row not seen in the last frame has confidence 0.

    last_seen_s: the stamp of the last frame that showed each row; centres: plants of the last frame in each;
    hold_s: how long a row not seen is still believed.
    """

    rows: tuple[RowLine, ...]
    last_seen_s: tuple[float, ...]
    centres: tuple[int, ...]
    stamp_s: float
    hold_s: float = DEFAULT_HOLD_S

    @property
    def rows_seen(self) -> int:
        """How many rows the last frame showed."""
        return sum(row.confidence > 0 for row in self.rows)

    def unseen_s(self, stamp_s: float) -> float:
        """For how long no row at all has been seen."""
        return stamp_s - max(self.last_seen_s)

    def held(self, stamp_s: float) -> tuple[bool, ...]:
        """Which rows were seen within `hold_s`."""
        return tuple(stamp_s - seen_s <= self.hold_s for seen_s in self.last_seen_s)

    def lost(self, stamp_s: float) -> bool:
        """Whether no row at all has been seen for `hold_s`; one row lost is not the lane lost."""
        return not any(self.held(stamp_s))


@dataclass(frozen=True, slots=True)
class Feature:
    """The average line of the lane's rows (paper III-B).

    offset_px: where it meets the image's bottom edge, to the right of the centre; theta_rad: its angle from
    the image's vertical, positive clockwise, so when it leans to the right towards the top.
    """

    offset_px: float
    theta_rad: float


def start(fit: LaneFit, stamp_s: float, hold_s: float = DEFAULT_HOLD_S) -> TrackedRows:
    """Begin to track the lane found at `stamp_s`."""
    count = len(fit.rows)
    return TrackedRows(fit.rows, (stamp_s,) * count, (0,) * count, stamp_s, hold_s)


def track(
    rows: TrackedRows, centres: Centres, stamp_s: float, crop: CropProfile, camera: Pinhole
) -> TrackedRows:
    """Move the rows to where the plants of a new frame show them.

    A row with fewer plants in its parallelogram than the profile asks for counts as not seen and goes along
    with the others; so does one that has drifted off its place between them, which is put back.
    """
    plane = canopy_plane(camera, crop)
    followed = follow(comb_of(rows.rows, crop, plane), on_ground(centres, crop, camera), crop)
    last_seen_s = tuple(
        stamp_s if now else before for now, before in zip(followed.seen, rows.last_seen_s, strict=True)
    )
    return TrackedRows(
        followed.comb.in_image(followed.confidence, plane),
        last_seen_s,
        tuple(int(count) for count in followed.counts),
        stamp_s,
        float(crop.tracking.hold_s),
    )


def feature(rows: tuple[RowLine, ...], camera: Pinhole) -> Feature:
    """The average line of the lane's rows, those not seen included: without them it would jump sideways."""
    bottom = float(np.mean([row.x_bottom_px for row in rows]))
    top = float(np.mean([row.x_top_px for row in rows]))
    return Feature(bottom - camera.centre_x_px, atan2(top - bottom, camera.height_px - 1))
