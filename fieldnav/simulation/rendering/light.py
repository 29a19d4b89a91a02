"""Sun and sky: how bright a leaf is, and where its shadow falls."""

from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np
from numpy.typing import NDArray

from fieldnav.settings.field import Light

LOWEST_SHADOW_DEG = 12.0  # shadows grow no longer than of a sun this low
SUN_SHARE = (
    0.6  # of the brightness of sunlit ground under a clear sky that the sun gives, as a camera sees it
)
TRANSLUCENCY = 0.75  # brightness of a leaf lit from behind, over one lit from the front
LOW_LEAF = 0.5  # brightness at the foot of a plant over that at its top
TYPICAL_FACING = 0.7  # cosine of a leaf to the sun that counts as fully lit


@dataclass(frozen=True, slots=True)
class Lighting:
    """The sun's direction as seen from the ground, unit vector (3,), and its share of the light."""

    towards_sun: NDArray[np.float32]
    shadow_per_metre: NDArray[np.float32]
    sun_share: float

    def on_leaves(self, normals: NDArray[np.float32], height: NDArray[np.float32]) -> NDArray[np.float32]:
        """Brightness of leaves, shape (n,), about 1 in full light.

        normals: shape (n, 3), unit, facing up; height: shape (n,), 0 at the plant's foot, 1 at its top.
        """
        facing = normals @ self.towards_sun
        sun = np.where(facing >= 0, facing, -facing * TRANSLUCENCY) / TYPICAL_FACING
        sky = (1 + normals[:, 2]) / 2
        depth = LOW_LEAF + (1 - LOW_LEAF) * np.sqrt(height)
        return np.asarray(depth * (self.sun_share * sun + (1 - self.sun_share) * sky), dtype=np.float32)


def make_lighting(light: Light) -> Lighting:
    """The lighting of a field."""
    azimuth, elevation = radians(light.sun_azimuth_deg), radians(light.sun_elevation_deg)
    flat = np.array([cos(azimuth), sin(azimuth)])
    steepness = radians(max(light.sun_elevation_deg, LOWEST_SHADOW_DEG))
    towards = np.array([*(flat * cos(elevation)), sin(elevation)], np.float32)
    shadow = np.asarray(-flat * cos(steepness) / sin(steepness), np.float32)
    return Lighting(towards, shadow, SUN_SHARE * light.sunshine)
