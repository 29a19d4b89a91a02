"""A camera above the ground, drawn at random: where points of the ground appear on the canvas.

On the ground one unit of length is the distance between two rows; x points across the rows, y along them and
away from the camera. How large a field is cannot be told from an image, so no metres are needed.
"""

from dataclasses import dataclass
from math import cos, inf, radians, sin, tan

import numpy as np
from numpy.typing import NDArray

from fieldnav.training.canvas import HEIGHT_PX, WIDTH_PX, Range, chance, log_uniform

Floats = NDArray[np.float64]

FOCAL_WIDTHS: Range = (0.5, 1.3)  # focal length in image widths: 90 to 42 degrees across
TILTS = (  # share of the cameras, limits of the tilt below the horizontal in degrees
    (0.55, (14.0, 40.0)),  # looks ahead, often with the horizon in view
    (0.30, (40.0, 72.0)),  # looks at the ground before the robot
    (0.15, (72.0, 90.0)),  # looks straight down
)
ROLL_DEG = 2.0  # standard deviations
YAW_DEG = 9.0
USUAL_YAW_SHARE, WIDE_YAW_DEG = 0.65, (-50.0, 50.0)  # the rest: a robot that turns
SPACINGS_ACROSS: Range = (1.1, 11.0)  # rows that fit into the width, low in the image
SPACING_LEVEL = 0.72  # of the height: where they are counted
SQUEEZED_SHARE, SQUEEZE = 0.5, (0.7, 1.7)  # images whose sides were scaled apart
DISTORTION = 0.03  # standard deviations of the lens's radial term,
HILL, HILL_TILT_RAD = 0.25, radians(45)  # of rising or falling ground far off, seen at less tilt only,
CENTRE_SHIFT = 0.03  # of the optical axis, in widths
ASIDE: Range = (-0.5, 0.5)  # where the camera stands between two rows
BEND_SHARE, BEND = 0.5, 0.004  # share of curved fields; deviation of x per y squared
CUBIC_SHARE, CUBIC, CUBIC_FADE = 0.3, 0.0004, 20.0  # of fields with an S; per y cubed, fading over y
DOWNWARD_RAD = 1.5  # from here on there is no horizon
MIN_DEPTH = 1e-3  # nearer points are behind the camera
MAX_SIDES = (
    1.6  # points farther out than so many widths or heights are dropped: the lens term would fold them back
)
MAX_RADIUS_SQUARED = 4.0  # in half widths; the lens term is held beyond
OUTSIDE_PX = -1e6  # where a point lies that is not in front of the camera
MIN_SQUASH = 0.08


@dataclass(frozen=True, slots=True)
class Projected:
    """Points of the ground on the canvas, each array of shape (n,).

    scale_px: pixels of one row spacing across, 0 behind the camera; squash: about the sine of the angle at
    which the ground is seen, the height of a circle on the ground over its width.
    """

    x_px: Floats
    y_px: Floats
    scale_px: Floats
    squash: Floats

    def __len__(self) -> int:
        return len(self.x_px)

    def __getitem__(self, chosen: NDArray[np.generic] | slice) -> "Projected":
        """The points chosen by a mask, by their numbers or by a slice."""
        return Projected(self.x_px[chosen], self.y_px[chosen], self.scale_px[chosen], self.squash[chosen])

    def within(
        self, min_scale_px: float, beside_px: float, above_px: float, below_px: float
    ) -> NDArray[np.bool_]:
        """Which points are large enough and lie on the canvas or within these margins of it."""
        inside_x = (self.x_px > -beside_px) & (self.x_px < WIDTH_PX + beside_px)
        inside_y = (self.y_px > -above_px) & (self.y_px < HEIGHT_PX + below_px)
        return np.asarray((self.scale_px > min_scale_px) & inside_x & inside_y)

    def far_to_near(self) -> NDArray[np.intp]:
        """The order in which nearer things cover those behind them."""
        return np.argsort(self.scale_px)


@dataclass(frozen=True, slots=True)
class GroundCamera:
    """A pinhole camera with a little distortion over a field that bends and may rise; lengths in spacings."""

    focal_px: float
    height: float
    tilt_rad: float
    roll_rad: float
    yaw_rad: float
    centre_x_px: float
    squeeze: float
    distortion: float
    hill: float
    aside: float
    bend: float
    cubic: float

    @property
    def horizon_px(self) -> float:
        """Image row of the horizon, minus infinity for a camera that looks down."""
        if self.tilt_rad >= DOWNWARD_RAD:
            return -inf
        return HEIGHT_PX / 2 - self.focal_px * tan(self.tilt_rad)

    def project(self, x: Floats, y: Floats) -> Projected:
        """Where ground points, each array of shape (n,) in row spacings, appear."""
        x = x + self.aside + self.bend * y * y + self.cubic * y**3 * np.exp(-np.abs(y) / CUBIC_FADE)
        across = cos(self.yaw_rad) * x + sin(self.yaw_rad) * y
        ahead = -sin(self.yaw_rad) * x + cos(self.yaw_rad) * y
        depth = ahead * cos(self.tilt_rad) + self.height * sin(self.tilt_rad)
        seen = depth > MIN_DEPTH
        depth = np.where(seen, depth, 1)
        right = self.focal_px * across / depth
        down = self.focal_px * (self.height * cos(self.tilt_rad) - ahead * sin(self.tilt_rad)) / depth
        down = down - self.hill * HEIGHT_PX * np.clip(-down / HEIGHT_PX, 0, 1) ** 2
        seen &= (np.abs(right) < MAX_SIDES * WIDTH_PX) & (np.abs(down) < MAX_SIDES * HEIGHT_PX)
        scale = self.focal_px / depth
        x_px, y_px = self._through_lens(right, down)
        return Projected(
            np.where(seen, x_px, OUTSIDE_PX),
            np.where(seen, y_px, OUTSIDE_PX),
            np.where(seen, scale, 0),
            np.clip(scale * self.height / self.focal_px, MIN_SQUASH, 1),
        )

    def _through_lens(self, right: Floats, down: Floats) -> tuple[Floats, Floats]:
        """Pixels from the ideal image: distorted, squeezed, rolled."""
        radius_squared = np.minimum((right**2 + down**2) / (WIDTH_PX / 2) ** 2, MAX_RADIUS_SQUARED)
        growth = 1 + self.distortion * radius_squared
        right, down = right * growth, down * growth * self.squeeze
        turned = cos(self.roll_rad) * right - sin(self.roll_rad) * down
        return turned + self.centre_x_px, sin(self.roll_rad) * right + cos(
            self.roll_rad
        ) * down + HEIGHT_PX / 2


def draw_camera(random: np.random.Generator) -> GroundCamera:
    """A camera as robots, tractors and people carry one."""
    focal_px = random.uniform(*FOCAL_WIDTHS) * WIDTH_PX
    tilt_rad = _draw_tilt(random)
    roll_rad = radians(random.normal(0, ROLL_DEG))
    usual = chance(random, USUAL_YAW_SHARE)
    yaw_rad = radians(random.normal(0, YAW_DEG) if usual else random.uniform(*WIDE_YAW_DEG))
    spacing_px = WIDTH_PX / log_uniform(random, SPACINGS_ACROSS)
    level = (SPACING_LEVEL - 0.5) * HEIGHT_PX / focal_px
    return GroundCamera(
        focal_px=focal_px,
        height=focal_px / spacing_px * (sin(tilt_rad) + level * cos(tilt_rad)),
        tilt_rad=tilt_rad,
        roll_rad=roll_rad,
        yaw_rad=yaw_rad,
        squeeze=random.uniform(*SQUEEZE) if chance(random, SQUEEZED_SHARE) else 1.0,
        distortion=random.normal(0, DISTORTION),
        hill=random.normal(0, HILL) * (tilt_rad < HILL_TILT_RAD),
        aside=random.uniform(*ASIDE),
        bend=random.normal(0, BEND) * chance(random, BEND_SHARE),
        cubic=random.normal(0, CUBIC) * chance(random, CUBIC_SHARE),
        centre_x_px=WIDTH_PX / 2 + random.normal(0, CENTRE_SHIFT) * WIDTH_PX,
    )


def _draw_tilt(random: np.random.Generator) -> float:
    kind = random.random()
    for share, limits_deg in TILTS[:-1]:
        if kind < share:
            return radians(random.uniform(*limits_deg))
        kind -= share
    return radians(random.uniform(*TILTS[-1][1]))
