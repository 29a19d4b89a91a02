"""Rows carried along by the motion that the wheels report, and how far that can be trusted.

Dead reckoning is good to some 3 % and a degree over a sidestep; the error grows like a random walk.
"""

from dataclasses import dataclass, replace
from math import cos, exp, hypot, isfinite, sin

import numpy as np

from fieldnav.messages import CameraName, Floats
from fieldnav.odometry import Pose
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.sidestep.passing_rows import Crossing, lean_sd, look_at_m, usual_length_m
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

SLIP_M2_PER_M = 0.0014
"""Variance of the place per metre travelled: 4.5 cm after a sidestep of 1.5 m."""
TURN_ASIDE_RAD2_PER_M, TURN_AHEAD_RAD2_PER_M = 2e-4, 4e-5
"""Variance of the heading per metre: a degree after 1.5 m sideways, from wheels that differ by 2 %."""
TURN_SHARE = 0.1
"""Standard deviation of a turn over the turn."""
APART_M2_PER_M = 1e-4
"""Variance of one row's place against the others' per metre: rows are not quite parallel."""
NEW_PLANTS_M = 0.3
"""Of driving along the rows after which other plants are in view."""


@dataclass(frozen=True, slots=True)
class Travelled:
    """How the robot moved between two frames, in the axes that a camera had before it moved."""

    ahead_m: float = 0.0
    left_m: float = 0.0
    turn_rad: float = 0.0

    @property
    def distance_m(self) -> float:
        return hypot(self.ahead_m, self.left_m)


def travelled(before: Pose, after: Pose, camera: CameraName) -> Travelled:
    """The motion from one pose to another as that camera sees it."""
    c, s = cos(before.heading_rad), sin(before.heading_rad)
    x, y = after.x_m - before.x_m, after.y_m - before.y_m
    looking = 1 if camera is CameraName.FRONT else -1
    return Travelled(
        looking * (c * x + s * y), looking * (c * y - s * x), after.heading_rad - before.heading_rad
    )


def carried(crossing: Crossing, moved: Travelled, crop: CropProfile, camera: Pinhole) -> Crossing:
    """The rows where they must be after the motion, less surely known than before."""
    outward, about_m = crossing.outward, look_at_m(canopy_plane(camera, crop))
    count = len(crossing.rows)
    change_m = outward * (crossing.slope * moved.ahead_m - moved.left_m - about_m * moved.turn_rad)
    turns = np.eye(len(crossing.covariance))
    turns[:count, 2 * count] = outward * moved.ahead_m
    noise = np.zeros_like(crossing.covariance)
    noise[:count, :count] = SLIP_M2_PER_M * moved.distance_m
    own = np.arange(count)
    noise[own, own] += APART_M2_PER_M * moved.distance_m
    same = exp(-abs(moved.ahead_m) / NEW_PLANTS_M)
    turns[count + own, count + own] = same
    noise[count + own, count + own] = (1 - same**2) * _lean_variance(crossing, crop, camera)
    swing = np.zeros(len(noise))
    swing[:count], swing[2 * count] = outward * about_m, 1.0
    turning = TURN_ASIDE_RAD2_PER_M * abs(moved.left_m) + TURN_AHEAD_RAD2_PER_M * abs(moved.ahead_m)
    turning += (TURN_SHARE * moved.turn_rad) ** 2
    noise += turning * np.outer(swing, swing)
    return replace(
        crossing,
        rows=tuple(
            replace(
                row, across_m=row.across_m + change_m, lean=same * row.lean, end_m=row.end_m - moved.ahead_m
            )
            for row in crossing.rows
        ),
        slope=crossing.slope - moved.turn_rad,
        covariance=turns @ crossing.covariance @ turns.T + noise,
        viewed_m=crossing.viewed_m + change_m,
    )


def _lean_variance(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> Floats:
    """Variance of each row's lean by the length of it in view, shape (rows,)."""
    plane = canopy_plane(camera, crop)
    near_m, far_m = plane.view_m
    unseen_m = far_m - usual_length_m(plane)
    ends = [row.end_m if isfinite(row.end_m) else unseen_m for row in crossing.rows]
    return np.array([lean_sd(crop, far_m - max(near_m, end_m)) ** 2 for end_m in ends])
