"""The plants of a frame on the ground, and how far each may stand from its row (paper III-A.3)."""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Centres, Floats
from fieldnav.perception.canopy import canopy_plane, half_width_px
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

FULL_COVER = 0.3  # of a square as wide as the canopy: a region of this area counts as a whole plant
LEAST_WEIGHT = 0.05


@dataclass(frozen=True, slots=True)
class GroundPlants:
    """Plants in the camera's ground coordinates, at the height of the canopy's middle.

    position_m: shape (n, 2); half_width_m: shape (n,), half the width of a row's parallelogram where the
    plant stands; weight: shape (n,), its area against that of a whole plant of the crop, at most 1.
    """

    position_m: Floats
    half_width_m: Floats
    weight: Floats

    def __len__(self) -> int:
        return len(self.weight)


def on_ground(centres: Centres, crop: CropProfile, camera: Pinhole) -> GroundPlants:
    """Where the plants of a frame stand; those above the ground that counts are far off."""
    plane = canopy_plane(camera, crop)
    y = centres.position_px[:, 1]
    across = plane.pixels_per_metre(y).clip(1)
    along = across * across * plane.height_m / plane.focal_px
    whole_px = FULL_COVER * crop.plants.canopy_width_m**2 * across * along
    position_m = np.nan_to_num(plane.to_ground(centres.position_px), nan=FAR_M)
    if plane.top_px:
        position_m[y < plane.top_px] = FAR_M
    return GroundPlants(
        position_m,
        half_width_px(y, crop, camera) / across,
        np.asarray((centres.area_px / whole_px).clip(LEAST_WEIGHT, 1.0)),
    )


FAR_M = 1e6
