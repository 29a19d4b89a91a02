"""How the robot stands before the next lane, and how surely that is known."""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from fieldnav.perception.sidestep.next_lane import NextLane
from fieldnav.perception.sidestep.passing_rows import Crossing


@dataclass(frozen=True, slots=True)
class Entry:
    """The robot's centre against a new lane: distance outward to its middle, angle, and how surely.

    slope: of the lane on the ground in the camera's coordinates.
    """

    offset_m: float
    slope: float
    offset_sd_m: float
    slope_sd: float


def entry(crossing: Crossing, lane: NextLane, about_m: float) -> Entry:
    """Where the robot would enter the lane; about_m: where rows are placed, ahead of the robot's centre."""
    count = len(crossing.rows)
    seen = [row for row in lane.rows if row >= 0]
    of_offset = np.zeros(len(crossing.covariance))
    of_offset[seen] = 1 / max(1, len(seen))
    of_offset[2 * count] = -crossing.outward * about_m
    variance = float(of_offset @ crossing.covariance @ of_offset)
    return Entry(
        lane.middle_m - crossing.outward * crossing.slope * about_m,
        crossing.slope,
        sqrt(max(variance, 0.0)),
        sqrt(float(crossing.covariance[2 * count, 2 * count])),
    )
