"""Rows passing sideways: which row is which while the robot moves across them (paper III-C).

As the robot moves, the distances to all rows shrink together; how fast is seen, not taken from the wheels.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Centres, Floats
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.passing import (
    SAME_ROW,
    SMALLEST_MASS,
    carried_along,
    lean_of,
    row_beyond,
    row_of,
)
from fieldnav.perception.passing_rows import (
    Crossing,
    PassingRow,
    look_at_m,
    row_in_view,
)
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

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
ROUNDS = 2
SMOOTHING = 0.1
"""Share that one frame has in what a row usually shows."""


def follow(
    crossing: Crossing, centres: Centres, crop: CropProfile, camera: Pinhole, turned_rad: float = 0.0
) -> Crossing:
    """Carry the rows along with the plants of a new frame, and look for a row beyond the outermost.

    turned_rad: by how much the robot was told to turn since the last frame. The heading is filtered over many
    frames; without it the filter would lag behind the turn and the robot swing to and fro.
    """
    crossing = replace(crossing, slope=crossing.slope - turned_rad)
    plane = canopy_plane(camera, crop)
    plants = on_ground(centres, crop, camera)
    ahead, left = plants.position_m.T
    ahead, weight = ahead - look_at_m(plane), plants.weight
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
    return _looked_beyond(moved, across, weight, crop)


def _looked_beyond(crossing: Crossing, across: Floats, weight: Floats, crop: CropProfile) -> Crossing:
    """With the candidate for a new row that plants beyond the outermost row make, if they make one."""
    least_m = crossing.outermost.across_m + NEW_ROW * crop.rows.spacing_m
    place = row_beyond(across, weight, least_m, crossing.usual_mass, crop)
    if place is None:
        return replace(crossing, candidate_m=None, candidate_frames=0)
    last = crossing.candidate_m
    again = last is not None and abs(place - last) < SAME_ROW * crop.rows.spacing_m
    return replace(
        crossing, candidate_m=place, candidate_frames=crossing.candidate_frames + 1 if again else 1
    )


def _usual_mass(
    crossing: Crossing, row: NDArray[np.int64], weight: Floats, crop: CropProfile, camera: Pinhole
) -> float:
    """The middle of what the known rows that stand wholly in the view hold, smoothed over frames."""
    mass = np.bincount(row[row >= 0], weight[row >= 0], len(crossing.rows))
    whole = [
        mass[index]
        for index, each in enumerate(crossing.rows)
        if row_in_view(crossing, each.across_m, crop, camera)
    ]
    if not whole:
        return crossing.usual_mass
    now = float(np.median(whole))
    return now if crossing.usual_mass == 0 else crossing.usual_mass + SMOOTHING * (now - crossing.usual_mass)


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
