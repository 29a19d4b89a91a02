"""The pinhole camera over flat ground: pixels to metres and back.

Ground coordinates of a camera: origin at the robot's centre of rotation on the ground, x in the direction the
camera looks (the robot's forward for the front camera, backward for the rear one), y to the left of that.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import cos, sin, tan

import numpy as np

from fieldnav.messages import Floats, RowLine


@dataclass(frozen=True, slots=True)
class Pinhole:
    """A camera above the ground, `forward_m` ahead of the robot's centre, tilted below the horizontal.

    top_px: the image row from which on down the image shows ground that counts: 0 for a camera that looks at
    the ground alone. Above it lie the horizon, what stands up from the ground, and ground too far away.
    """

    width_px: int
    height_px: int
    focal_px: float
    height_m: float
    tilt_rad: float
    forward_m: float
    top_px: float = 0.0

    def to_image(self, ground_m: Floats) -> Floats:
        """Project ground points, shape (..., 2), to pixels, shape (..., 2); NaN behind the camera."""
        ahead = ground_m[..., 0] - self.forward_m
        depth = ahead * cos(self.tilt_rad) + self.height_m * sin(self.tilt_rad)
        depth = np.where(depth > 0, depth, np.nan)
        down = self.height_m * cos(self.tilt_rad) - ahead * sin(self.tilt_rad)
        u = self.centre_x_px - self.focal_px * ground_m[..., 1] / depth
        v = self.centre_y_px + self.focal_px * down / depth
        return np.stack([u, v], axis=-1)

    def to_ground(self, image_px: Floats) -> Floats:
        """Ground points, shape (..., 2), that pixels, shape (..., 2), see; NaN above the horizon."""
        x = (image_px[..., 0] - self.centre_x_px) / self.focal_px
        y = (image_px[..., 1] - self.centre_y_px) / self.focal_px
        drop = sin(self.tilt_rad) + y * cos(self.tilt_rad)
        depth = self.height_m / np.where(drop > 0, drop, np.nan)
        ahead = depth * (cos(self.tilt_rad) - y * sin(self.tilt_rad))
        return np.stack([self.forward_m + ahead, -x * depth], axis=-1)

    def pixels_per_metre(self, v_px: Floats | float) -> Floats:
        """Image width of one metre across the ground, at image rows `v_px`."""
        y = (np.asarray(v_px, dtype=float) - self.centre_y_px) / self.focal_px
        return np.asarray(self.focal_px * (sin(self.tilt_rad) + y * cos(self.tilt_rad)) / self.height_m)

    def row_on_ground(self, row: RowLine) -> tuple[float, float]:
        """The ground line y = offset + slope * x of a row line, as (offset_m, slope)."""
        last = self.height_px - 1.0
        ends = [[row.at(self.top_px, last), self.top_px], [row.x_bottom_px, last]]
        far, near = self.to_ground(np.array(ends))
        slope = float((far[1] - near[1]) / (far[0] - near[0]))
        return float(near[1] - slope * near[0]), slope

    def row_in_image(self, offset_m: float, slope: float, confidence: float = 1.0) -> RowLine:
        """The row line that a ground line y = offset + slope * x makes; inverse of `row_on_ground`."""
        near_m, far_m = self.view_m
        ground = np.array([[far_m, offset_m + slope * far_m], [near_m, offset_m + slope * near_m]])
        far, near = self.to_image(ground)
        x_top_px, x_bottom_px = float(far[0]), float(near[0])
        if self.top_px:  # the line is carried on, past the horizon, to the image's upper edge
            last = self.height_px - 1.0
            x_top_px = x_bottom_px + (x_top_px - x_bottom_px) * last / (last - self.top_px)
        return RowLine(x_top_px, x_bottom_px, confidence)

    @property
    def view_m(self) -> tuple[float, float]:
        """Distance ahead of the robot's centre of the nearest and the furthest ground that counts.

        These are seen at the image's lower edge and at `top_px`.
        """
        return _view_m(self)

    @property
    def horizon_px(self) -> float:
        """The image row of the horizon; negative above the image, and without bound straight down."""
        return self.centre_y_px - self.focal_px * tan(self.tilt_rad)

    @property
    def sky_px(self) -> float:
        """How many image rows look above the horizon: rows are drawn up to there."""
        return max(0.0, self.horizon_px)

    @property
    def ground_middle_px(self) -> float:
        """The image row midway between `top_px` and the image's lower edge."""
        return (self.top_px + self.height_px - 1) / 2

    def seen_at_px(self, below_horizon_rad: float) -> float:
        """The image row that looks so far below the horizontal."""
        return self.centre_y_px - self.focal_px * tan(self.tilt_rad - below_horizon_rad)

    @property
    def centre_x_px(self) -> float:
        return (self.width_px - 1) / 2

    @property
    def centre_y_px(self) -> float:
        return (self.height_px - 1) / 2


@lru_cache(maxsize=64)
def _view_m(camera: Pinhole) -> tuple[float, float]:
    edges = np.array([[camera.centre_x_px, camera.height_px - 1.0], [camera.centre_x_px, camera.top_px]])
    near, far = camera.to_ground(edges)[:, 0]
    return float(near), float(far)
