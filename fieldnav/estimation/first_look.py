"""How surely a first look at a lane is believed: the filter's covariance before anything else was seen."""

import numpy as np

from fieldnav.messages import Floats

# Standard deviations of what a first look tells: offset, slope, curvature (a bend of 12 m has 0.08/m) and its
# change with distance.
FIRST = np.array([0.03, 0.04, 0.05, 0.02])
FIRST_AT_M = 1.3  # in front of the robot's centre, where the first look sees the rows
FIRST_PLACE_M, FIRST_SIDESLIP, FIRST_YAW_PER_M = 0.02, 0.03, 0.02
KNOT_SD_M = 3e-4  # of a knot from the curve through the three before it: rows wander over metres
PUSHES = 2


def first_covariance(ahead_m: Floats, rows: int) -> Floats:
    """Covariance of the knots, of the rows' places, of sideslip and yaw per metre.

    ahead_m: how far ahead of the robot's centre each knot lies, shape (n,). Square, n + rows + 2 a side.
    """
    x, n = ahead_m - FIRST_AT_M, len(ahead_m)
    terms = np.stack([np.ones(n), x, x**2 / 2, x**3 / 6], axis=-1) * FIRST
    covariance = np.zeros((n + rows + PUSHES,) * 2)
    covariance[:n, :n] = terms @ terms.T + KNOT_SD_M**2 * np.eye(n)
    covariance[n:-PUSHES, n:-PUSHES] = FIRST_PLACE_M**2 * apart(rows)
    covariance[-2, -2], covariance[-1, -1] = FIRST_SIDESLIP**2, FIRST_YAW_PER_M**2
    return covariance


def apart(rows: int) -> Floats:
    """Covariance of places that differ from each other while their mean stays, shape (rows, rows)."""
    return np.eye(rows) - 1 / rows
