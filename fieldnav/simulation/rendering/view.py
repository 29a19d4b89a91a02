"""Where a camera stands and what it sees of the world."""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats

FARTHEST_M = 4.5  # of ground that is looked at; beyond it a picture only needs to be filled
LEAST_DROP = 1e-3  # rays this flat never reach the ground
SKY_BGR = (230, 222, 210)  # a bright overcast day


@dataclass(frozen=True, slots=True)
class View:
    """A pinhole camera in the world.

    position_m: shape (3,), world coordinates, z up from the ground; rotation: shape (3, 3), camera to world,
    its columns the camera's axes: x right, y down, z forward. The principal point is the picture's middle.
    farthest_m: how far away plants are drawn, ahead and to either side.
    """

    width_px: int
    height_px: int
    focal_px: float
    position_m: Floats
    rotation: Floats
    farthest_m: float = FARTHEST_M

    def mirrored(self) -> "View":
        """The view whose picture, flipped left to right, shows the world flipped about its x axis."""
        across_world, across_camera = np.array([1.0, -1.0, 1.0]), np.array([-1.0, 1.0, 1.0])
        return View(
            self.width_px,
            self.height_px,
            self.focal_px,
            self.position_m * across_world,
            self.rotation * across_world[:, None] * across_camera,
            self.farthest_m,
        )

    @property
    def intrinsics(self) -> Floats:
        """Shape (3, 3), camera coordinates to homogeneous pixels."""
        centre_x, centre_y = (self.width_px - 1) / 2, (self.height_px - 1) / 2
        return np.array([[self.focal_px, 0, centre_x], [0, self.focal_px, centre_y], [0, 0, 1.0]])

    @property
    def projection(self) -> Floats:
        """Shape (3, 3): world points relative to the camera's position to homogeneous pixels."""
        return np.asarray(self.intrinsics @ self.rotation.T)

    @property
    def ground(self) -> Floats:
        """Homography, shape (3, 3): homogeneous pixels to homogeneous world (x, y); the last is never up."""
        x, y, z = self.position_m
        drop = np.array([[z, 0, -x], [0, z, -y], [0, 0, -1.0]])
        return np.asarray(drop @ self.rotation @ np.linalg.inv(self.intrinsics))

    @property
    def sky_px(self) -> Floats | None:
        """Corners (4, 2) of what lies above the horizon, in the picture and a little beside it; or None."""
        left, down, level = np.array([0, 0, 1.0]) @ self.rotation @ np.linalg.inv(self.intrinsics)
        sides = np.array([-1.0, self.width_px])
        if down >= -LEAST_DROP / self.focal_px:  # straight down, or upside down
            return None
        horizon = -(level + LEAST_DROP + left * sides) / down
        if (horizon < 0).all():
            return None
        upper = min(float(horizon.min()), 0.0) - 1.0
        return np.array(
            [[sides[0], upper], [sides[1], upper], [sides[1], horizon[1]], [sides[0], horizon[0]]]
        )

    def footprint(self, height_m: float, farthest_m: float = FARTHEST_M) -> tuple[Floats, Floats]:
        """Lower and upper corner (2,) of the box around what is seen of the level at `height_m`."""
        right, bottom = self.width_px - 1.0, self.height_px - 1.0
        corners = np.array([[0, 0, 1.0], [right, 0, 1], [right, bottom, 1], [0, bottom, 1]])
        rays = corners @ np.linalg.inv(self.intrinsics).T @ self.rotation.T
        fall = np.maximum(-rays[:, 2:], LEAST_DROP)
        reach = np.clip((self.position_m[2] - height_m) * rays[:, :2] / fall, -farthest_m, farthest_m)
        reach = np.where(-rays[:, 2:] > LEAST_DROP, reach, np.sign(rays[:, :2]) * farthest_m)
        seen = self.position_m[:2] + reach
        return seen.min(axis=0), seen.max(axis=0)
