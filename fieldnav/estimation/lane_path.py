"""The lane's path as a Kalman filter of knots: seen ahead, carried along under the robot, seen again behind.

What a camera shows of the lane lies a metre and more from the robot's centre, which is where the cross-track
error counts. Instead of drawing the line back to the centre, the path is remembered as the robot drives onto
it. How the robot moves is what its wheels report; how it is pushed sideways and turned beyond that (side
slope, steering zeros, unequal wheels, a camera that looks aside) is estimated along with the path, as are the
rows' own places in the lane.

The state is [c of each knot, place of each row, sideslip, yaw per metre], as errors from where they are held.
"""

from math import atan, hypot

import numpy as np
from numpy.typing import NDArray

from fieldnav.estimation.first_look import KNOT_SD_M, apart, first_covariance
from fieldnav.estimation.knots import EXTRAPOLATION, straight
from fieldnav.estimation.lane_state import LaneState
from fieldnav.estimation.sighting import Sighting, information
from fieldnav.messages import Floats
from fieldnav.odometry import Pose

BEHIND_M = 2.0  # as far as the trailing camera looks
# Random walks, as standard deviations after one metre: of the robot against its wheels (sideways, turning,
# and as a share of each turn), of what pushes it, of a row's place in the lane.
ASIDE_M, TURN_RAD, TURN_SHARE = 0.005, 0.005, 0.05
SIDESLIP_DRIFT, YAW_DRIFT_PER_M, PLACE_DRIFT_M = 0.002, 0.002, 0.004
LEAST_STEP_M = 1e-3  # of driving between frames that show the same plants anew
SAME_PLANTS_M = 0.3  # of driving after which a plant is another one: many looks at it are few plants' word


class LanePath:
    """The lane's path about a robot; `pose` was it last carried to, its heading that of travel."""

    def __init__(
        self, pose: Pose, offset_m: float, slope: float, place_m: Floats, scatter_m: float, ahead_m: float
    ) -> None:
        """Begin with a first look: the lane's middle at y = offset + slope x.

        place_m: shape (rows,), each row's place to the left of the middle; scatter_m: standard deviation of a
        whole plant from its row; ahead_m: how far the camera that leads looks.
        """
        self.pose = pose
        self.place_m = place_m.copy()
        self._scatter_m, self._ahead_m = scatter_m, ahead_m
        self._sideslip = self._yaw_per_m = 0.0
        self._step_m = SAME_PLANTS_M
        self._knots = straight(pose, offset_m, slope, -BEHIND_M, ahead_m)
        self._covariance = first_covariance(self._knots.seen_from(pose)[:, 0], len(place_m))

    def carry(self, pose: Pose) -> None:
        """Go on to a later pose, as the wheels report it."""
        moved = np.array([pose.x_m - self.pose.x_m, pose.y_m - self.pose.y_m])
        step_m = float(moved @ [np.cos(pose.heading_rad), np.sin(pose.heading_rad)])
        turn, driven_m = abs(pose.heading_rad - self.pose.heading_rad), abs(step_m)
        ahead = self._knots.seen_from(pose)
        lateral = np.array([-np.sin(pose.heading_rad), np.cos(pose.heading_rad)])
        aside = -self._knots.normal @ lateral
        turned = aside * ahead[:, 0]
        n = len(self._knots)
        change = np.eye(len(self._covariance))
        change[:n, -2], change[:n, -1] = step_m * aside, step_m * turned
        covariance = change @ self._covariance @ change.T
        spread_m2 = driven_m * ASIDE_M**2
        turned_rad2 = driven_m * TURN_RAD**2 + (TURN_SHARE * turn) ** 2
        covariance[:n, :n] += spread_m2 * np.outer(aside, aside) + turned_rad2 * np.outer(turned, turned)
        covariance[n:-2, n:-2] += driven_m * PLACE_DRIFT_M**2 * apart(len(self.place_m))
        covariance[-2, -2] += driven_m * SIDESLIP_DRIFT**2
        covariance[-1, -1] += driven_m * YAW_DRIFT_PER_M**2
        self._knots = self._knots.moved(step_m * (self._sideslip * aside + self._yaw_per_m * turned))
        self._covariance, self.pose, self._step_m = covariance, pose, self._step_m + driven_m
        self._shift_window()

    def _shift_window(self) -> None:
        """New knots ahead where the curve goes on, none left further behind than is ever looked."""
        x = self._knots.seen_from(self.pose)[:, 0]
        while x[-1] < self._ahead_m:
            n = len(self._knots)
            grow = np.insert(np.eye(len(self._covariance)), n, 0.0, axis=0)
            grow[n, n - 3 : n] = EXTRAPOLATION
            self._covariance = grow @ self._covariance @ grow.T
            self._covariance[n, n] += KNOT_SD_M**2
            self._knots = self._knots.extended()
            x = self._knots.seen_from(self.pose)[:, 0]
        behind = int((x < -BEHIND_M).sum())
        if behind:
            self._knots = self._knots.dropped(behind)
            self._covariance = self._covariance[behind:, behind:]

    def rows_of(self, sighting: Sighting) -> tuple[NDArray[np.int64], Floats, Floats]:
        """The row that each plant belongs to, -1 for none; how far left of it it stands; the knots' parts."""
        beside, weights = self._knots.beside(sighting.position_m, self.pose)
        off = beside[:, None] - self.place_m
        row = np.abs(off).argmin(axis=1)
        off = off[np.arange(len(row)), row]
        known = (sighting.position_m[:, 0] <= self._ahead_m) & (sighting.position_m[:, 0] >= -BEHIND_M)
        return np.where((np.abs(off) <= sighting.reach_m) & known, row, -1), off, weights

    def see(self, sighting: Sighting) -> NDArray[np.int64]:
        """Take in the plants of a frame taken at `pose`; returns how many each row has, shape (rows,)."""
        row, off, weights = self.rows_of(sighting)
        inside = row >= 0
        counts = np.bincount(row[inside], minlength=len(self.place_m))
        if inside.any() and self._step_m >= LEAST_STEP_M:
            self._update(row[inside], off[inside], weights[inside], sighting.weight[inside])
            self._step_m = 0.0
        return counts

    def _update(self, row: NDArray[np.int64], off: Floats, weights: Floats, whole: Floats) -> None:
        n = len(self._knots)
        design = np.zeros((len(row), len(self._covariance)))
        design[:, :n] = weights
        design[np.arange(len(row)), n + row] = 1.0
        new = min(1.0, self._step_m / SAME_PLANTS_M)
        told, wanted = information(design, off, whole, self._covariance, self._scatter_m, new)
        covariance = np.linalg.solve(np.eye(len(told)) + self._covariance @ told, self._covariance)
        self._covariance = (covariance + covariance.T) / 2
        error = self._covariance @ wanted
        self._knots = self._knots.moved(error[:n])
        self.place_m = self.place_m + error[n:-2]
        self._sideslip += float(error[-2])
        self._yaw_per_m += float(error[-1])

    def rows_at(self, ahead_m: Floats, pose: Pose) -> Floats:
        """y of each row at distances ahead of a pose, in its frame, shape (len(ahead_m), rows)."""
        x, y = self._knots.seen_from(pose).T
        return np.asarray(np.interp(ahead_m, x, y)[:, None] + self.place_m)

    def state(self, pose: Pose) -> LaneState:
        """The robot against the lane at a pose close to the last one."""
        (middle, slope, bend), functional = self._knots.curve_at(pose)
        n = len(self._knots)
        spread = np.sqrt(np.einsum("ij,jk,ik->i", functional, self._covariance[:n, :n], functional))
        steep = hypot(1, slope)
        return LaneState(
            offset_m=-middle / steep,
            heading_rad=-atan(slope),
            curvature_per_m=bend / steep**3,
            offset_sd_m=float(spread[0]),
            heading_sd_rad=float(spread[1]),
            sideslip=self._sideslip,
            yaw_per_m=self._yaw_per_m,
        )
