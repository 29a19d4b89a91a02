"""Single plants: connected regions of the vegetation and their centres of mass (paper III-A.1)."""

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Centres, Floats, Image
from fieldnav.perception.regions import Regions, divide, of_mask
from fieldnav.perception.vegetation import Cover, vegetation_of
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import Vegetation

CLOSED = 0.9
"""Share of the ground in the picture: a canopy closed over the soil shows no rows."""


def find_plants(image: Image, vegetation: Vegetation, camera: Pinhole) -> Centres:
    """The plants of an image; see `plants_in`."""
    return plants_in(vegetation_of(image, vegetation, camera.top_px), vegetation, camera)


def plants_in(cover: Cover, vegetation: Vegetation, camera: Pinhole) -> Centres:
    """The plants of an image's vegetation.

    Regions smaller than the profile's area at their place are left out, those taller than its limit are
    divided. Where hardly anything else is left to see, plants cannot be told apart and there are none. The
    camera must be that of the image: pixels of both are the same.
    """
    mask = cover.mask
    if cv2.countNonZero(mask) > CLOSED * cover.ground_share * mask.size:
        return NO_PLANTS
    scale = np.array([cover.width_px / mask.shape[1], cover.height_px / mask.shape[0]])
    labels, found = of_mask(mask)
    large = _area_m2(found, scale, camera) >= vegetation.smallest_area_m2
    sections = _sections(found, scale[1], vegetation.tallest_region_m, camera)
    return _centres(divide(labels, found, sections * large), scale)


def _area_m2(found: Regions, scale: Floats, camera: Pinhole) -> Floats:
    """Area on the ground of regions; 0 above the horizon."""
    across = camera.pixels_per_metre(to_full(found.y, scale[1])).clip(0)
    per_m2 = across * along_pixels_per_metre(across, camera)
    area = found.area * scale.prod()
    return np.asarray(np.divide(area, per_m2, out=np.zeros(len(area)), where=per_m2 > 0))


def _sections(found: Regions, scale: float, tallest_m: float, camera: Pinhole) -> NDArray[np.int64]:
    """Into how many pieces each region is divided, at least 1."""
    middle = to_full((found.top + found.bottom) / 2, scale)
    tallest_px = tallest_m * along_pixels_per_metre(camera.pixels_per_metre(middle), camera)
    height_px = (found.bottom - found.top + 1) * scale
    sections = np.ceil(height_px / tallest_px.clip(1)).clip(1, found.bottom - found.top + 1)
    return np.asarray(sections, dtype=np.int64)


def along_pixels_per_metre(across: Floats, camera: Pinhole) -> Floats:
    """Image height of one metre along the ground where a metre across it is `across` pixels wide."""
    return np.asarray(across * across * camera.height_m / camera.focal_px)


def to_full(position: Floats, scale: float) -> Floats:
    """Pixel positions of a smaller image in the full one; pixel centres lie at whole numbers in both."""
    return np.asarray((position + 0.5) * scale - 0.5)


def _centres(pieces: Regions, scale: Floats) -> Centres:
    position = np.stack([to_full(pieces.x, scale[0]), to_full(pieces.y, scale[1])], axis=-1)
    top = pieces.top * scale[1]
    return Centres(position, pieces.area * scale.prod(), top, (pieces.bottom + 1) * scale[1] - 1)


NO_PLANTS = Centres(np.empty((0, 2)), np.empty(0), np.empty(0), np.empty(0))
