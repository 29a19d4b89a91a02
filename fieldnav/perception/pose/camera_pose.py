"""Where a camera looks, told by rows of known spacing: its tilt, its height and its yaw against the rows.

With x and y in focal lengths from the image's centre, row k from the left lies at
x = a + b y + k s (p + q y), rows being s apart, and p = sin(tilt) / h, q = cos(tilt) / h for a camera h above
them: how fast the rows converge is the tilt, how far apart they lie the height. The yaw is in a and b.

What this cannot tell apart:
- the yaw of the camera on its mount and the heading of the robot, in one frame: over a stretch driven along
  the rows the mean is the mount's, and that of a robot which always crabs or drives in a bend;
- roll and yaw: at 65 degrees of tilt a degree of roll moves the vanishing point sideways as 0.9 degrees of
  yaw do. That it also spreads the rows on one side more is a quarter of a pixel for three rows 0.35 m apart;
- a focal length 2 % off and 0.4 degrees of tilt; rows sown 3 % closer, or a crop that stands higher than the
  profile has it, and a camera that hangs 3 cm higher or lower.

The plants are taken, not the rows' lines: rows are followed as the parallels that the file's camera makes of
them, so that a knocked camera shows in their lines by less than half.
"""

from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Centres, Floats, RowLine
from fieldnav.perception.canopy import canopy_plane, line_px
from fieldnav.perception.follow import scatter_m, widest_m
from fieldnav.perception.ground_plants import on_ground
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

FEWEST_ROWS = 2
FEWEST_PLANTS = 3  # of a row, so that one weed does not turn it
COEFFICIENTS = 4
HUBER = 1.5  # residuals beyond so many standard deviations count linearly
ROUNDS = 3  # of reweighting
PRIOR_PLANTS = 1  # as good as one plant is the profile's word on how far plants scatter


@dataclass(frozen=True, slots=True)
class PoseSighting:
    """One frame's word on a camera, as `plane`, shape (3,), in which its errors are even, and covariance.

    plane: sin(tilt) / h and cos(tilt) / h in 1/m, h being the height above the middle of the canopy, and the
    slope on the ground, to the left, of the rows against the camera. covariance: shape (3, 3).
    """

    plane: Floats
    covariance: Floats


def sight(
    rows: tuple[RowLine, ...], centres: Centres, crop: CropProfile, camera: Pinhole
) -> PoseSighting | None:
    """The camera's pose by the plants along a lane's rows; None when they are too few to tell.

    rows: all of the lane's, left to right; centres: the frame's plants; camera: the robot file's.
    """
    if len(rows) < FEWEST_ROWS:
        return None
    row, inside = _rows_of(rows, centres, crop, camera)
    if inside.sum() <= COEFFICIENTS or np.ptp(row[inside]) < 1:
        return None
    position_px, row = centres.position_px[inside], row[inside]
    x = (position_px[:, 0] - camera.centre_x_px) / camera.focal_px
    y = (position_px[:, 1] - camera.centre_y_px) / camera.focal_px
    place_m = (row - (len(rows) - 1) / 2) * crop.rows.spacing_m
    across = canopy_plane(camera, crop).pixels_per_metre(position_px[:, 1]) / camera.focal_px
    sure = np.sqrt(on_ground(centres, crop, camera).weight[inside]) / (scatter_m(crop) * across)
    fitted = _fit(np.stack([np.ones_like(y), y, place_m, place_m * y], axis=-1), x, sure)
    return None if fitted is None else _sighting(*fitted, camera.tilt_rad)


def _rows_of(
    rows: tuple[RowLine, ...], centres: Centres, crop: CropProfile, camera: Pinhole
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """The row nearest to each plant, and whether it is near enough, in a row of enough; shape (n,) each."""
    x, y = centres.position_px.T
    off = np.abs(x - np.stack([line_px(row, y, camera) for row in rows]))
    row = off.argmin(axis=0)
    near = off.min(axis=0) <= widest_m(crop) * canopy_plane(camera, crop).pixels_per_metre(y)
    counts = np.bincount(row[near], minlength=len(rows))
    return row, near & (counts[row] >= FEWEST_PLANTS)


def _fit(design: Floats, x: Floats, sure: Floats) -> tuple[Floats, Floats] | None:
    """Coefficients, shape (4,), and their covariance by reweighted least squares; None where they are free.

    design: shape (n, 4); x: shape (n,); sure: shape (n,), one over the standard deviation of x.
    """
    trust = sure**2
    for _ in range(ROUNDS):
        weighted = design.T * trust
        try:
            covariance = np.linalg.inv(weighted @ design)
        except np.linalg.LinAlgError:
            return None
        coefficients = covariance @ (weighted @ x)
        off = np.abs(x - design @ coefficients) * sure
        trust = sure**2 * np.minimum(1.0, HUBER / np.maximum(off, HUBER))
    squares = float((np.minimum(off, HUBER) ** 2).sum())
    scatter = (squares + PRIOR_PLANTS) / (len(x) - COEFFICIENTS + PRIOR_PLANTS)
    return np.asarray(coefficients), np.asarray(covariance * scatter)


def _sighting(coefficients: Floats, covariance: Floats, tilt_rad: float) -> PoseSighting:
    """The tilt is the file's here: an error of it only lends the slope a little of the lane's offset."""
    pick = np.zeros((3, COEFFICIENTS))
    pick[0, 2] = pick[1, 3] = 1.0
    pick[2, :2] = -cos(tilt_rad), sin(tilt_rad)
    return PoseSighting(pick @ coefficients, pick @ covariance @ pick.T)
