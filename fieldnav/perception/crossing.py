"""Rows passing sideways: which row is which while the robot moves across them (paper III-C).

Rows are held as distances `across_m` from the robot, measured on the ground at one image row in the middle of
the upper half, where the row ends are still seen; positive towards the side the robot moves to. As the robot
moves, all of them shrink together; how fast is seen, not taken from the wheels.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Centres, Floats, RowLine
from fieldnav.perception.canopy import canopy_plane, half_width_px, line_px
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.passing import (
    SAME_ROW,
    SMALLEST_MASS,
    carried_along,
    lean_of,
    row_beyond,
    row_of,
)
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

LOOK_AT = 0.25
"""The image row at which rows are placed, over the image's height."""
NEW_ROW = 0.6
"""A row is a new one when it lies past the outermost by more than this share of the row spacing."""
OFF_SPACING = 0.3
"""New rows stand a whole number of row spacings apart, within this share of one."""
MOST_SKIPPED = 2
"""Row spacings between two new rows in a chain: one row may have failed to grow at its end."""
SCATTER_M = 0.03
"""Standard deviation of the middle of what is seen of a plant from its row."""
SLOPE_DRIFT = 0.003
"""Standard deviation of the heading's change from one frame to the next."""
FIRST_SLOPE = 0.05
"""Standard deviation of the heading that the lane's rows gave; single looks err by several degrees."""
ROUNDS = 2
SMOOTHING = 0.1
"""Share that one frame has in what a row usually shows."""


@dataclass(frozen=True, slots=True)
class PassingRow:
    """One row; number 0 is the outermost row of the old lane, 1 the first new row, -1 the old lane's next."""

    number: int
    across_m: float


@dataclass(frozen=True, slots=True)
class Crossing:
    """The rows known, their common slope on the ground, and the candidate for a new row.

    outward: +1 when the robot moves to the left of the camera's view, -1 when to the right.
    """

    outward: int
    rows: tuple[PassingRow, ...]
    slope: float
    slope_variance: float = FIRST_SLOPE**2
    candidate_m: float | None = None
    candidate_frames: int = 0
    usual_mass: float = 0.0
    """Whole plants that a row shows here, as the rows known so far show them."""

    @property
    def outermost(self) -> PassingRow:
        return max(self.rows, key=lambda row: row.number)

    @property
    def passed(self) -> int:
        """How many new rows have come."""
        return self.outermost.number


def begin(rows: tuple[RowLine, ...], outward: int, crop: CropProfile, camera: Pinhole) -> Crossing:
    """Start from the rows of the lane that the robot leaves."""
    plane = canopy_plane(camera, crop)
    across = sorted((_across_m(row, outward, plane) for row in rows), reverse=True)
    slope = float(np.mean([plane.row_on_ground(row)[1] for row in rows]))
    return Crossing(outward, tuple(PassingRow(-index, place) for index, place in enumerate(across)), slope)


def follow(crossing: Crossing, centres: Centres, crop: CropProfile, camera: Pinhole) -> Crossing:
    """Carry the rows along with the plants of a new frame, and look for a row beyond the outermost."""
    plane = canopy_plane(camera, crop)
    plants = on_ground(centres, crop, camera)
    ahead, left = plants.position_m.T
    ahead, weight = ahead - _look_at_m(plane), plants.weight
    across = crossing.outward * (left - crossing.slope * ahead)
    places = np.array([row.across_m for row in crossing.rows])
    for _ in range(ROUNDS):
        row = row_of(across, places, crop)
        places = carried_along(places, across, weight, row)
    lean, spread_m2 = lean_of(ahead, across, weight, row, len(places))
    variance = crossing.slope_variance + SLOPE_DRIFT**2
    # A Kalman filter of one state: plants close together along the rows say little of the heading.
    trust = variance / (variance + SCATTER_M**2 / max(spread_m2, SMALLEST_MASS))
    slope = crossing.slope + trust * crossing.outward * lean
    rows = tuple(
        replace(old, across_m=float(place)) for old, place in zip(crossing.rows, places, strict=True)
    )
    moved = replace(crossing, rows=rows, slope=slope, slope_variance=(1 - trust) * variance)
    moved = replace(moved, usual_mass=_usual_mass(moved, row, weight, crop, camera))
    least = moved.outermost.across_m + NEW_ROW * crop.rows.spacing_m
    candidate = row_beyond(across, weight, least, moved.usual_mass, crop)
    if candidate is None:
        return replace(moved, candidate_m=None, candidate_frames=0)
    last = crossing.candidate_m
    again = last is not None and abs(candidate - last) < SAME_ROW * crop.rows.spacing_m
    return replace(
        moved, candidate_m=candidate, candidate_frames=crossing.candidate_frames + 1 if again else 1
    )


def _usual_mass(
    crossing: Crossing, row: NDArray[np.int64], weight: Floats, crop: CropProfile, camera: Pinhole
) -> float:
    """The middle of what the known rows that stand wholly in the view hold, smoothed over frames."""
    plane = canopy_plane(camera, crop)
    mass = np.bincount(row[row >= 0], weight[row >= 0], len(crossing.rows))
    whole = [
        mass[index]
        for index, each in enumerate(crossing.rows)
        if _in_view(_line(crossing, each.across_m, plane), crop, camera)
    ]
    if not whole:
        return crossing.usual_mass
    now = float(np.median(whole))
    return now if crossing.usual_mass == 0 else crossing.usual_mass + SMOOTHING * (now - crossing.usual_mass)


def candidate_row(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> RowLine | None:
    """The candidate's line, once enough frames have shown it and it stands wholly in the view."""
    if crossing.candidate_m is None or crossing.candidate_frames < crop.recognition.confirm_frames:
        return None
    return _in_view(_line(crossing, crossing.candidate_m, canopy_plane(camera, crop)), crop, camera)


def outermost_row(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> RowLine | None:
    """The outermost known row's line, if it stands wholly in the view."""
    return _in_view(_line(crossing, crossing.outermost.across_m, canopy_plane(camera, crop)), crop, camera)


def _in_view(line: RowLine, crop: CropProfile, camera: Pinhole) -> RowLine | None:
    at = np.array([0.0, camera.centre_y_px])
    room = line_px(line, at, camera), half_width_px(at, crop, camera)
    inside = (room[0] - room[1] >= 0) & (room[0] + room[1] <= camera.width_px - 1)
    return line if inside.all() else None


def accept(crossing: Crossing, crop: CropProfile) -> Crossing:
    """The candidate is a new row.

    New rows are a row spacing apart; where one is not, what was taken for a row before was none (weeds
    between the lanes), and the count begins again with this one.
    """
    assert crossing.candidate_m is not None, "there is a candidate to accept"
    outermost, place = crossing.outermost, crossing.candidate_m
    rows, number = crossing.rows, 1
    if outermost.number > 0:
        spacings = (place - outermost.across_m) / crop.rows.spacing_m
        steps = round(spacings)
        if 1 <= steps <= MOST_SKIPPED and abs(spacings - steps) <= OFF_SPACING:
            number = outermost.number + steps
        else:
            rows = tuple(row for row in rows if row.number <= 0)
    return replace(crossing, rows=(*rows, PassingRow(number, place)), candidate_m=None, candidate_frames=0)


def new_lane_m(crossing: Crossing, crop: CropProfile) -> float:
    """Distance from the robot, positive outward, to the middle of the new lane, where the rows are placed.

    Raises ValueError when no new row has come.
    """
    new = [row for row in crossing.rows if row.number > 0]
    if not new:
        raise ValueError("no new row has come yet")
    middle = (crop.rows.per_lane + 1) / 2
    return float(np.mean([row.across_m + (middle - row.number) * crop.rows.spacing_m for row in new]))


def rows_in_image(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> tuple[RowLine, ...]:
    """The known rows as lines of the image, left to right."""
    plane = canopy_plane(camera, crop)
    lines = (_line(crossing, row.across_m, plane) for row in crossing.rows)
    return tuple(sorted(lines, key=lambda line: line.x_bottom_px))


def _look_at_m(plane: Pinhole) -> float:
    at = np.array([plane.centre_x_px, LOOK_AT * plane.height_px])
    return float(plane.to_ground(at)[0])


def _across_m(row: RowLine, outward: int, plane: Pinhole) -> float:
    offset_m, slope = plane.row_on_ground(row)
    return outward * (offset_m + slope * _look_at_m(plane))


def _line(crossing: Crossing, across_m: float, plane: Pinhole) -> RowLine:
    offset_m = crossing.outward * across_m - crossing.slope * _look_at_m(plane)
    return plane.row_in_image(offset_m, crossing.slope)
