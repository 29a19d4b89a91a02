"""Rows corrected by the plants of a frame: a Kalman filter of their places, heading and the camera's errors.

A camera that hangs otherwise than its file says spreads the ground: lengths across grow by the scale, and
by the tilt times the distance ahead. Rows on one side alone then seem to lean. Both errors are part of the
state, so that they are not taken for a turn of the robot. A robot that rolls moves all rows of a frame.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import scatter_m
from fieldnav.perception.ground_plants import GroundPlants
from fieldnav.perception.sidestep.passing_rows import Crossing, look_at_m
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

SAME_ROW = 0.4
"""A plant may belong to a row within this share of the row spacing."""
MEMBER = 0.6
"""And does within this share of the canopy's width, once the frame's own shift is known."""
NARROWEST_M = 0.05
"""But at least this: plants scatter by 1.5 cm about rows that wander."""
ROLL_M = 0.03
"""Standard deviation of a frame's shift while the robot moves: 1.7 degrees of roll from 1 m up."""
RESTING_ROLL_M = 0.005
FULL_ROLL_AT_M = 0.01
"""Motion from one frame to the next at which the robot shakes fully."""
MOST_PLANTS = 6.0
"""What a row tells in a frame: many plants do not make its place surer than the row is straight."""
LEAST_SPREAD = 0.5
"""Plants at the horizon lie nowhere; they are kept from turning over."""
HUBER = 1.5
ROUNDS = 3


def belonging(across: Floats, weight: Floats, places: Floats, crop: CropProfile) -> NDArray[np.int64]:
    """The row that each plant belongs to, -1 for none; shape (n,). across, places: metres outward."""
    if not len(across):
        return np.empty(0, np.int64)
    away = across[:, None] - places[None, :]
    nearest = np.abs(away).argmin(axis=1)
    off = away[np.arange(len(across)), nearest]
    widest = SAME_ROW * crop.rows.spacing_m
    near = np.abs(off) <= widest
    common = _median(off[near], weight[near])
    within = min(widest, max(MEMBER * crop.plants.canopy_width_m, NARROWEST_M))
    return np.where(near & (np.abs(off - common) <= within), nearest, -1)


def straightened(crossing: Crossing, plants: GroundPlants, crop: CropProfile, camera: Pinhole) -> Floats:
    """How far outward the row that each plant stands in lies, were it a row; metres, shape (n,)."""
    plane = canopy_plane(camera, crop)
    x, y = plants.position_m.T
    spread = crossing.scale - (x - plane.forward_m) / plane.height_m * crossing.tilt_rad
    straight = crossing.outward * (y - crossing.slope * (x - look_at_m(plane)))
    return np.asarray(straight / np.maximum(1 + spread, LEAST_SPREAD))


def corrected(
    crossing: Crossing,
    plants: GroundPlants,
    row: NDArray[np.int64],
    moved_m: float,
    crop: CropProfile,
    camera: Pinhole,
) -> Crossing:
    """The rows as the plants show them; row: that of each plant, -1 for none; moved_m: since the last."""
    inside = row >= 0
    if not inside.any():
        return crossing
    row, weight = row[inside], plants.weight[inside]
    held = np.bincount(row, weight, len(crossing.rows))
    weight = weight * np.minimum(1.0, MOST_PLANTS / np.maximum(held, MOST_PLANTS))[row]
    x, y = plants.position_m[inside].T
    design, known = _design(crossing, x, row, crop, camera)
    residual = crossing.outward * y - known
    roll_m = RESTING_ROLL_M + (ROLL_M - RESTING_ROLL_M) * min(1.0, moved_m / FULL_ROLL_AT_M)
    size = len(crossing.covariance)
    prior = np.zeros((size + 1, size + 1))
    prior[:size, :size] = np.linalg.inv(crossing.covariance)
    prior[size, size] = roll_m**-2.0
    scatter = scatter_m(crop)
    change: Floats = np.zeros(size + 1)
    for _ in range(ROUNDS):
        off = np.abs(residual - design @ change) * np.sqrt(weight) / scatter
        trust = weight / scatter**2 * np.minimum(1.0, HUBER / np.maximum(off, HUBER))
        weighted = design.T * trust
        information = weighted @ design + prior
        change = np.asarray(np.linalg.solve(information, weighted @ residual))
    return _changed(crossing, change, np.linalg.inv(information)[:size, :size])


def _design(
    crossing: Crossing, x: Floats, row: NDArray[np.int64], crop: CropProfile, camera: Pinhole
) -> tuple[Floats, Floats]:
    """How each plant's place hangs on the state and the frame's shift, and where it should be."""
    plane, count = canopy_plane(camera, crop), len(crossing.rows)
    ahead, beyond = x - look_at_m(plane), (x - plane.forward_m) / plane.height_m
    place = crossing.places_m[row]
    spread = crossing.scale - beyond * crossing.tilt_rad
    mine = np.equal.outer(row, np.arange(count)).astype(float)
    outward = crossing.outward * ahead
    rest = [outward, -place * beyond, place, np.ones(len(x))]
    design = np.hstack([mine * (1 + spread)[:, None], mine * outward[:, None], np.stack(rest, axis=-1)])
    slope = crossing.slope + np.array([each.lean for each in crossing.rows])[row]
    return design, place * (1 + spread) + outward * slope


def _changed(crossing: Crossing, change: Floats, covariance: Floats) -> Crossing:
    count = len(crossing.rows)
    slope, tilt_rad, scale = (float(each) for each in change[2 * count : 2 * count + 3])
    return replace(
        crossing,
        rows=tuple(
            replace(each, across_m=each.across_m + float(by), lean=each.lean + float(turn))
            for each, by, turn in zip(crossing.rows, change[:count], change[count : 2 * count], strict=True)
        ),
        slope=crossing.slope + slope,
        tilt_rad=crossing.tilt_rad + tilt_rad,
        scale=crossing.scale + scale,
        covariance=covariance,
    )


def _median(values: Floats, weight: Floats) -> float:
    """The weighted median; 0 of nothing."""
    if not len(values):
        return 0.0
    order = values.argsort()
    share = weight[order].cumsum()
    return float(values[order][int(np.searchsorted(share, share[-1] / 2))])
