"""The middle of a lane as knots on the ground: where they stand, how a point lies beside them.

Everything is in the frame of the robot's dead reckoning. A knot may move along its normal alone, by c; the
line between two knots moves by c interpolated. Neighbouring knots tell the lane's direction and curvature.
"""

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from fieldnav.messages import Floats
from fieldnav.odometry import Pose

STEP_M = 0.25  # sags by less than a millimetre in a bend of 12 m radius
FEWEST = 4  # knots for a parabola
WINDOW_M = 0.8  # to either side of a place: the knots that tell direction and curvature there


@dataclass(frozen=True, slots=True)
class Knots:
    """Places, shape (n, 2), and unit normals to the left of the lane's direction, shape (n, 2), in order."""

    place_m: Floats
    normal: Floats

    def __len__(self) -> int:
        return len(self.place_m)

    def seen_from(self, pose: Pose) -> Floats:
        """Places in the frame of a pose, x ahead and y left, shape (n, 2)."""
        return (self.place_m - [pose.x_m, pose.y_m]) @ _axes(pose).T

    def moved(self, c_m: Floats) -> "Knots":
        """Each knot moved along its normal, shape (n,)."""
        return Knots(self.place_m + c_m[:, None] * self.normal, self.normal)

    def dropped(self, count: int) -> "Knots":
        """Without the first ones."""
        return Knots(self.place_m[count:], self.normal[count:])

    def extended(self) -> "Knots":
        """With one more, where the curve through the last three goes on."""
        last = self.place_m[-3:]
        place = EXTRAPOLATION @ last
        along = place - last[-1]
        along = along / np.hypot(*along)
        normal = np.array([-along[1], along[0]])
        return Knots(np.vstack([self.place_m, last[-1] + STEP_M * along]), np.vstack([self.normal, normal]))

    def beside(self, points_m: Floats, pose: Pose) -> tuple[Floats, Floats]:
        """Distance of points, shape (m, 2) in the frame of a pose, to the left of the line, shape (m,); and
        how much of each knot's movement it takes part in, shape (m, n).
        """
        x, y = self.seen_from(pose).T
        after = np.searchsorted(x, points_m[:, 0]).clip(1, len(x) - 1)
        share = (points_m[:, 0] - x[after - 1]) / (x[after] - x[after - 1])
        slope = (y[after] - y[after - 1]) / (x[after] - x[after - 1])
        on_line = y[after - 1] + slope * (points_m[:, 0] - x[after - 1])
        weights = np.zeros((len(points_m), len(x)))
        every = np.arange(len(points_m))
        weights[every, after - 1], weights[every, after] = 1 - share, share
        return (points_m[:, 1] - on_line) / np.hypot(1, slope), weights

    def curve_at(self, pose: Pose) -> tuple[Floats, Floats]:
        """Value, slope and curvature of the line beside a pose, in its frame, shape (3,).

        With how they come from the knots' y, shape (3, n): a parabola through the knots near by.
        """
        x, y = self.seen_from(pose).T
        near = np.abs(x) <= WINDOW_M
        if near.sum() < FEWEST:  # at either end of what is known
            near = np.abs(x) <= np.sort(np.abs(x))[FEWEST - 1]
        terms = np.stack([np.ones(near.sum()), x[near], x[near] ** 2 / 2], axis=-1)
        functional = np.zeros((3, len(x)))
        functional[:, near] = np.linalg.solve(terms.T @ terms, terms.T)
        return functional @ y, functional


EXTRAPOLATION = np.array([1.0, -3.0, 3.0])
"""A curve of constant second difference."""


def straight(pose: Pose, offset_m: float, slope: float, from_m: float, to_m: float) -> Knots:
    """Knots along y = offset + slope x in the frame of a pose, from one x to another."""
    x = np.arange(from_m, to_m + STEP_M, STEP_M)
    axes = _axes(pose)
    places = np.stack([x, offset_m + slope * x], axis=-1) @ axes + [pose.x_m, pose.y_m]
    normal = np.array([-slope, 1.0]) / np.hypot(1, slope) @ axes
    return Knots(places, np.repeat(normal[None], len(x), axis=0))


def _axes(pose: Pose) -> Floats:
    """The frame's x and y axes, shape (2, 2), as rows."""
    c, s = cos(pose.heading_rad), sin(pose.heading_rad)
    return np.array([[c, s], [-s, c]])
