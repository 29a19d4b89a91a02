"""Rows passing sideways: which row is which while the robot moves across them (paper III-C).

Rows are held as distances `across_m` from the robot, measured on the ground at one image row in the middle of the
upper half, where the row ends are still seen; positive towards the side the robot moves to. As the robot moves, all
of them shrink together; how fast is seen, not taken from the wheels.
"""

from dataclasses import dataclass, replace

import numpy as np

from fieldnav.messages import RowLine
from fieldnav.perception.canopy import canopy_plane, half_width_px, line_px
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

LOOK_AT = 0.25
"""The image row at which rows are placed, over the image's height."""
SAME_ROW = 0.4
"""A line belongs to a known row within this share of the row spacing; a frame moves the rows by 1 cm."""
NEW_ROW = 0.6
"""A row is a new one when it lies past the outermost by more than this share of the row spacing."""
OFF_SPACING = 0.3
"""New rows stand a whole number of row spacings apart, within this share of one."""
MOST_SKIPPED = 2
"""Row spacings between two new rows in a chain: one row may have failed to grow at its end."""
SLOPE_BLEND = 0.1
"""Weight of one frame's heading in the running one; single frames err by several degrees."""
PLACE_BLEND = 0.5


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
    candidate_m: float | None = None
    candidate_frames: int = 0

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


def follow(crossing: Crossing, lines: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole) -> Crossing:
    """Carry the rows along with the lines of a new frame."""
    plane = canopy_plane(camera, crop)
    spacing_m = crop.rows.spacing_m
    seen = np.array([_across_m(line, crossing.outward, plane) for line in lines])
    before = np.array([row.across_m for row in crossing.rows])
    away = np.abs(seen[None, :] - before[:, None])
    nearest = away.argmin(axis=1) if len(seen) else np.zeros(len(before), int)
    found = away.min(axis=1, initial=np.inf) < SAME_ROW * spacing_m
    residual = np.where(found, seen[nearest] - before, 0.0) if len(seen) else np.zeros_like(before)
    shift = float(np.median(residual[found])) if found.any() else 0.0
    places = before + shift + PLACE_BLEND * np.where(found, residual - shift, 0.0)
    rows = tuple(
        PassingRow(row.number, float(place)) for row, place in zip(crossing.rows, places, strict=True)
    )
    slopes = [plane.row_on_ground(lines[index])[1] for index in nearest[found]]
    slope = crossing.slope + SLOPE_BLEND * (float(np.mean(slopes)) - crossing.slope if slopes else 0.0)
    moved = replace(crossing, rows=rows, slope=slope)
    beyond = seen[seen > moved.outermost.across_m + NEW_ROW * spacing_m]
    if not len(beyond):
        return replace(moved, candidate_m=None, candidate_frames=0)
    candidate = float(beyond.min())
    last = crossing.candidate_m
    again = last is not None and abs(candidate - last - shift) < SAME_ROW * spacing_m
    return replace(
        moved, candidate_m=candidate, candidate_frames=crossing.candidate_frames + 1 if again else 1
    )


def candidate_row(crossing: Crossing, crop: CropProfile, camera: Pinhole) -> RowLine | None:
    """The candidate's line, once enough frames have shown it and it stands wholly in the view."""
    if crossing.candidate_m is None or crossing.candidate_frames < crop.recognition.confirm_frames:
        return None
    line = _line(crossing, crossing.candidate_m, canopy_plane(camera, crop))
    at = np.array([0.0, camera.centre_y_px])
    room = line_px(line, at, camera), half_width_px(at, crop, camera)
    inside = (room[0] - room[1] >= 0) & (room[0] + room[1] <= camera.width_px - 1)
    return line if inside.all() else None


def accept(crossing: Crossing, crop: CropProfile) -> Crossing:
    """The candidate is a new row.

    New rows are a row spacing apart; where one is not, what was taken for a row before was none (weeds between the
    lanes), and the count begins again with this one.
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
