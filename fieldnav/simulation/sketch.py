"""A sketch of the field as a camera sees it: plain soil, every plant a flat green star of leaves.

It stands in for FieldRenderer where what counts is where plants stand and not how they look: at half size it
costs a millisecond a picture.
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats, Image
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.simulation.plan import FieldPlan
from fieldnav.simulation.rendering.view import SKY_BGR, View

LEAVES = 6  # of every plant
NOTCH = 0.45  # how far leaves are parted: a star covers a third of its square, as plants do on average
SEEN_AT = 0.5  # of a plant's height: where most of what a camera sees of it lies
CROP_BGR, WEED_BGR = (46.0, 124.0, 74.0), (52.0, 132.0, 92.0)  # of leaves in an even light
NEAREST_M = 0.1  # in front of the camera: a plant nearer than this is not in any picture
SUBPIXEL_BITS = 4  # of the corners that OpenCV fills between


class SketchRenderer:
    """Draws one field from any view; no light, no wind, no weather: a picture depends on the view alone."""

    def __init__(self, plan: FieldPlan, field: FieldSettings, crop: CropProfile) -> None:
        plants = plan.plants
        self._plan = plan
        self._bare_soil = np.array(field.ground.colour_bgr, np.uint8)[None, None]
        self._middle = np.stack([plants.x_m, plants.y_m, SEEN_AT * plants.height_m], axis=-1)
        self._radius_m, self._turn_rad = plants.diameter_m / 2, plants.heading_rad
        self._is_crop = plants.is_crop
        # Half of the widest plant may reach into a picture that its stem stands outside of.
        self._beside_m = max(float(self._radius_m.max(initial=0.0)), crop.plants.canopy_width_m / 2)
        self._star = _star()

    def render(self, view: View, time_s: float) -> Image:
        """The picture, shape (height, width, 3), blue, green, red; the time makes no difference."""
        picture = self._bare(view.height_px, view.width_px).copy()
        sky = view.sky_px
        if sky is not None:
            cv2.fillConvexPoly(picture, np.rint(sky).astype(np.int32), SKY_BGR)
        near = self._near(view)
        corners, before = self._corners_px(view, near)
        colours = np.where(self._is_crop[near][:, None], CROP_BGR, WEED_BGR)
        fixed = np.rint(corners * (1 << SUBPIXEL_BITS)).astype(np.int32)
        for corner, colour in zip(fixed[before], colours[before].tolist(), strict=True):
            cv2.fillPoly(picture, [corner], colour, shift=SUBPIXEL_BITS)
        return picture

    def _bare(self, height: int, width: int) -> Image:
        """A picture of the soil; kept, since filling one with a colour takes longer than all the rest."""
        if self._bare_soil.shape[:2] != (height, width):
            self._bare_soil = np.tile(self._bare_soil[:1, :1], (height, width, 1))
        return self._bare_soil

    def _near(self, view: View) -> NDArray[np.int64]:
        """The plants that may be in view, the lower ones first."""
        lower, upper = view.footprint(0.0, view.farthest_m)
        reach_m = float(np.hypot(*(upper - lower))) / 2 + self._beside_m
        near = self._plan.plants_near((lower + upper) / 2, reach_m)
        return near[np.argsort(self._middle[near, 2], kind="stable")]

    def _corners_px(self, view: View, near: NDArray[np.int64]) -> tuple[Floats, NDArray[np.bool_]]:
        """Corners of each plant's star, shape (n, corners, 2), and which plants are within the picture."""
        turn = self._turn_rad[near, None]
        along, across = self._star.T
        x = (along * np.cos(turn) - across * np.sin(turn)) * self._radius_m[near, None]
        y = (along * np.sin(turn) + across * np.cos(turn)) * self._radius_m[near, None]
        away = np.stack([x, y, np.zeros_like(x)], axis=-1) + (self._middle[near, None] - view.position_m)
        seen = away @ view.projection.T
        before = np.asarray((seen[..., 2] > NEAREST_M).all(axis=1))
        corners = seen[..., :2] / np.where(before[:, None], seen[..., 2], 1.0)[..., None]
        size = np.array([view.width_px, view.height_px])
        inside = (corners.max(axis=1) >= 0).all(axis=1) & (corners.min(axis=1) < size).all(axis=1)
        return corners, before & inside


def _star() -> Floats:
    """Corners of a star of leaves within the circle of radius 1, shape (2 * LEAVES, 2)."""
    angle = np.arange(2 * LEAVES) * np.pi / LEAVES
    radius = np.where(np.arange(2 * LEAVES) % 2 == 0, 1.0, NOTCH)
    return np.asarray(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1))
