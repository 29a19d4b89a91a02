"""A pose on the ground, and the poses that a robot lately had: dead reckoning from twists."""

from dataclasses import dataclass
from math import cos, hypot, sin

import numpy as np

from fieldnav.messages import Floats, Twist


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the robot's centre is, and its heading counter-clockwise from the frame's x."""

    x_m: float = 0.0
    y_m: float = 0.0
    heading_rad: float = 0.0

    def moved(self, twist: Twist, dt_s: float) -> "Pose":
        """The pose after driving a constant twist; exact to second order by turning half way first."""
        turn = twist.yaw_rate_rps * dt_s
        heading = self.heading_rad + turn / 2
        ahead, left = twist.vx_mps * dt_s, twist.vy_mps * dt_s
        return Pose(
            self.x_m + ahead * cos(heading) - left * sin(heading),
            self.y_m + ahead * sin(heading) + left * cos(heading),
            self.heading_rad + turn,
        )

    def distance_m(self, other: "Pose") -> float:
        """How far the centres are apart."""
        return hypot(other.x_m - self.x_m, other.y_m - self.y_m)

    def between(self, later: "Pose", share: float) -> "Pose":
        """The pose at a share of the way to a later one."""
        return Pose(
            self.x_m + share * (later.x_m - self.x_m),
            self.y_m + share * (later.y_m - self.y_m),
            self.heading_rad + share * (later.heading_rad - self.heading_rad),
        )


class Track:
    """The poses of the last moments, so that a frame can be given the place where it was taken."""

    def __init__(self, kept: int) -> None:
        self._kept, self._end = kept, 0
        # Twice as long as what is kept: a stretch without a break is at hand, and is seldom moved.
        self._table: Floats = np.zeros((4, 2 * kept))

    def add(self, stamp_s: float, pose: Pose) -> None:
        """Take in the pose at a time later than all before."""
        if self._end == self._table.shape[1]:
            self._table[:, : self._kept] = self._table[:, -self._kept :]
            self._end = self._kept
        self._table[:, self._end] = stamp_s, pose.x_m, pose.y_m, pose.heading_rad
        self._end += 1

    def at(self, stamp_s: float) -> Pose:
        """The pose at a time; that at the nearest time kept where it lies beyond them."""
        return Pose(*self.all_at(np.array([stamp_s]))[:, 0].tolist())

    def all_at(self, stamps_s: Floats) -> Floats:
        """The poses at many times, shape (n,), each as `at` gives it; shape (3, n): x, y, heading."""
        if self._end == 0:
            return np.zeros((3, len(stamps_s)))
        stamps, *columns = self._table[:, max(0, self._end - self._kept) : self._end]
        return np.stack([np.interp(stamps_s, stamps, column) for column in columns])
