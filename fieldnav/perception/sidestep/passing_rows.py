"""The rows that pass sideways, where each is and what speaks for it (paper III-C).

Rows are held as distances `across_m` from the robot, measured on the ground at one image row in the middle of
the upper half, where the row ends are still seen; positive towards the side the robot moves to.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import hypot, sqrt

import numpy as np

from fieldnav.messages import Floats, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

LOOK_AT = 0.25
"""The image row at which rows are placed, over the height of the ground in the image."""
FIRST_PLACE_M = 0.03
"""Standard deviation of a row's place as the lane's rows gave it."""
LENGTH_M, LENGTH_SHARE = 0.5, 0.5
"""Of a row just met that is in view past its end: at least so much, and that share of the ground in view."""
LEAST_LENGTH_M = 0.2
UNIFORM = sqrt(12.0)
"""A length over the standard deviation of places spread evenly over it."""
STRAY_M = 0.02
"""Standard deviation of a plant from its row, across."""
NOT_PARALLEL = 0.01
"""Standard deviation of a row's slope from the others'."""
TILT_RAD = 0.02
"""Standard deviation of the camera's tilt from its file: mounting and ground together, our choice."""
SCALE = 0.03
"""The same of lengths on the ground, from the camera's height and lens."""


@dataclass(frozen=True, slots=True)
class PassingRow:
    """One row, or what may be one.

    lean: slope of its few plants in view against the rows' slope; plants, features: what these say for a row
    that is new, as natural logarithms of odds; end_m: distance from the robot's centre to its nearest plant,
    infinite until one was seen; shown: what the last frame showed of it, 1 being a usual row wholly in view.
    """

    across_m: float
    lean: float = 0.0
    of_old_lane: bool = False
    plants: float = 0.0
    features: float = 0.0
    end_m: float = float("inf")
    shown: float = 0.0


@dataclass(frozen=True, slots=True)
class Crossing:
    """The rows under way, from the inside outward as they were met, and how well they are known.

    outward: +1 when the robot moves to the left of the camera's view, -1 when to the right; slope: of all
    rows on the ground in the camera's coordinates; tilt_rad, scale: by how much the camera hangs otherwise
    than its file says; covariance: of (across_m of each row, lean of each, slope, tilt, scale); viewed_m:
    distance up to which a row would have been seen; usual_mass: whole plants that a row shows here.
    """

    outward: int
    rows: tuple[PassingRow, ...]
    slope: float
    covariance: Floats = field(compare=False)
    tilt_rad: float = 0.0
    scale: float = 0.0
    viewed_m: float = 0.0
    usual_mass: float = 0.0

    @property
    def places_m(self) -> Floats:
        """Where the rows are, shape (rows,)."""
        return np.array([row.across_m for row in self.rows])

    @property
    def new(self) -> tuple[int, ...]:
        """Indices of the rows that are not the old lane's."""
        return tuple(index for index, row in enumerate(self.rows) if not row.of_old_lane)

    @property
    def outermost_old(self) -> int:
        """Index of the old lane's row nearest the next lane."""
        old = [index for index, row in enumerate(self.rows) if row.of_old_lane]
        return max(old, key=lambda index: self.rows[index].across_m)


def begin(
    rows: Sequence[RowLine], slope_sd: float, outward: int, crop: CropProfile, camera: Pinhole
) -> Crossing:
    """Start from the rows of the lane that the robot leaves; slope_sd: how well their heading is known."""
    plane = canopy_plane(camera, crop)
    ground = np.array([plane.row_on_ground(row) for row in rows])
    across = sorted(outward * (ground[:, 0] + ground[:, 1] * look_at_m(plane)))
    known = tuple(PassingRow(float(place), of_old_lane=True) for place in across)
    count, leans = len(known), lean_sd(crop, usual_length_m(plane))
    spread = np.repeat([FIRST_PLACE_M, leans, slope_sd, TILT_RAD, SCALE], [count, count, 1, 1, 1])
    return Crossing(outward, known, float(ground[:, 1].mean()), np.diag(np.square(spread)))


def usual_length_m(plane: Pinhole) -> float:
    """How much of a row is in view past its end: a camera that looks obliquely shows metres of it."""
    near_m, far_m = plane.view_m
    return max(LENGTH_M, LENGTH_SHARE * (far_m - near_m))


def lean_sd(crop: CropProfile, length_m: float) -> float:
    """Standard deviation of the slope that the plants in view of a row have against the row's.

    length_m: of the row that is in view.
    """
    length_m = max(length_m, LEAST_LENGTH_M)
    plants = max(1.0, length_m / crop.plants.spacing_m)
    return hypot(NOT_PARALLEL, STRAY_M / sqrt(plants) * UNIFORM / length_m)


def with_row(crossing: Crossing, row: PassingRow, crop: CropProfile, camera: Pinhole) -> Crossing:
    """With one more row, whose place is known no better than a single look tells."""
    count = len(crossing.rows)
    at = [count, 2 * count]
    covariance = np.insert(np.insert(crossing.covariance, at, 0.0, axis=0), at, 0.0, axis=1)
    covariance[count, count] = FIRST_PLACE_M**2
    length_m = usual_length_m(canopy_plane(camera, crop))
    covariance[2 * count + 1, 2 * count + 1] = lean_sd(crop, length_m) ** 2
    return replace(crossing, rows=(*crossing.rows, row), covariance=covariance)


def only(crossing: Crossing, kept: Sequence[int]) -> Crossing:
    """With these rows alone."""
    count = len(crossing.rows)
    index = [*kept, *(count + row for row in kept), *range(2 * count, len(crossing.covariance))]
    rows = tuple(crossing.rows[row] for row in kept)
    return replace(crossing, rows=rows, covariance=crossing.covariance[np.ix_(index, index)])


def look_at_m(plane: Pinhole) -> float:
    """Distance ahead of the robot's centre at which rows are placed."""
    at_px = plane.top_px + LOOK_AT * (plane.height_px - plane.top_px)
    at = np.array([plane.centre_x_px, at_px])
    return float(plane.to_ground(at)[0])
