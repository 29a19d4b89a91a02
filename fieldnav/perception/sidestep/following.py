"""A frame of the sidestep: rows carried along by the wheels, corrected by sight, judged, and new ones met."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Centres, Floats
from fieldnav.perception.canopy import half_width_px
from fieldnav.perception.ground_plants import GroundPlants, on_ground
from fieldnav.perception.sidestep.correction import belonging, corrected, straightened
from fieldnav.perception.sidestep.meeting import ROW_MASS, forgotten, met
from fieldnav.perception.sidestep.passing_rows import Crossing, PassingRow
from fieldnav.perception.sidestep.row_lines import row_in_view, view_limit_m
from fieldnav.perception.sidestep.row_words import by_plants, words
from fieldnav.perception.sidestep.wheel_motion import Travelled, carried
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

FRAME_M = 0.01
"""0.15 m/s at 15 frames/s."""
LEAST_FRAME = 0.2
"""What a look from where the robot stands is worth: leaves and light move."""
SMOOTHING = 0.1
"""Share that one frame has in what a row usually shows."""
PLANT_WEIGHT = 0.3
"""Of a whole plant, that one must have to be a row's end."""
END_SHARE = 0.3
"""Share of the way to the end now seen that a row's end goes in a frame."""


def follow(
    crossing: Crossing, centres: Centres, moved: Travelled, crop: CropProfile, camera: Pinhole
) -> Crossing:
    """The rows after a frame; moved: what the wheels report since the frame before."""
    crossing = carried(crossing, moved, crop, camera)
    limit_m = view_limit_m(crop, camera)
    crossing = replace(crossing, viewed_m=max(crossing.viewed_m, limit_m))
    plants = on_ground(_whole(centres, crop, camera), crop, camera)
    row = belonging(straightened(crossing, plants, crop, camera), plants.weight, crossing.places_m, crop)
    crossing = corrected(crossing, plants, row, moved.distance_m, crop, camera)
    across = straightened(crossing, plants, crop, camera)
    row = belonging(across, plants.weight, crossing.places_m, crop)
    crossing = _judged(crossing, plants, row, moved, crop, camera)
    if moved.distance_m > 0 or crossing.usual_mass > 0:
        crossing = met(crossing, across, plants.weight, row, crop, camera)
    return forgotten(crossing, crop)


def _whole(centres: Centres, crop: CropProfile, camera: Pinhole) -> Centres:
    """Without the plants at the sides of the view: of those that it cuts, the middle is not seen."""
    x, y = centres.position_px.T
    half = half_width_px(y, crop, camera)
    inside = (x >= half) & (x <= camera.width_px - 1 - half)
    return Centres(
        centres.position_px[inside],
        centres.area_px[inside],
        centres.top_px[inside],
        centres.bottom_px[inside],
    )


def _judged(
    crossing: Crossing,
    plants: GroundPlants,
    row: NDArray[np.int64],
    moved: Travelled,
    crop: CropProfile,
    camera: Pinhole,
) -> Crossing:
    """With the word of the plants and the end of each row."""
    count = len(crossing.rows)
    mass = np.bincount(row[row >= 0], plants.weight[row >= 0], count)
    whole = [row_in_view(crossing, each.across_m, crop, camera) is not None for each in crossing.rows]
    crossing = replace(crossing, usual_mass=_usual(crossing, mass.astype(float), np.array(whole), crop))
    usual = max(crossing.usual_mass, ROW_MASS)
    frames = max(LEAST_FRAME, min(1.0, moved.distance_m / FRAME_M))
    firm = plants.weight >= PLANT_WEIGHT
    rows = []
    for index, each in enumerate(crossing.rows):
        mine = (row == index) & firm
        seen = _end_seen(each, plants.position_m[mine, 0]) if mine.any() else each
        shown = float(mass[index]) / usual if whole[index] else 0.0
        word = by_plants(each.plants, shown, frames) if whole[index] else each.plants
        rows.append(replace(seen, plants=word, shown=shown))
    return replace(crossing, rows=tuple(rows))


def _end_seen(row: PassingRow, ahead_m: Floats) -> PassingRow:
    nearest = float(ahead_m.min())
    if not np.isfinite(row.end_m):
        return replace(row, end_m=nearest)
    return replace(row, end_m=min(row.end_m, row.end_m + END_SHARE * (nearest - row.end_m)))


def _usual(crossing: Crossing, mass: Floats, whole: NDArray[np.bool_], crop: CropProfile) -> float:
    """The middle of what the certain rows that stand wholly in the view hold, smoothed over frames."""
    certain = [
        float(mass[index])
        for index, row in enumerate(crossing.rows)
        if whole[index] and (row.of_old_lane or words(crossing, index, crop).certain)
    ]
    if not certain:
        return crossing.usual_mass
    now = float(np.median(certain))
    return now if crossing.usual_mass == 0 else crossing.usual_mass + SMOOTHING * (now - crossing.usual_mass)
