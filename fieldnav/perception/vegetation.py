"""Where plants are: excess green, Otsu's threshold, connected regions, centres of mass (paper III-A.1)."""

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Centres, Floats, Image
from fieldnav.perception.regions import Regions, divide, of_mask
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import Vegetation

Mask = NDArray[np.uint8]
"""Shape (height, width): 255 where there is vegetation, 0 elsewhere."""

FULL_SCALE = 255  # grey level that stands for an index of 1
COLOURS = 3
DARK_LEVEL = 26.0  # grey levels added to the brightness, so that sensor noise in the dark is not called green
WORKING_WIDTH_PX = (
    640  # regions are found at this width or just above: centres of mass lose no accuracy there
)
SMALLEST_SIDE_PX = 8  # an image less wide or high holds no rows


def excess_green(image: Image) -> NDArray[np.uint8]:
    """Excess green (2g - r - b) / (r + g + b) of each pixel, cut off below 0 (Woebbecke 1995).

    image: shape (h, w, 3), uint8, blue green red. Returns shape (h, w), uint8, 255 standing for an index of
    1.
    The brightness it is divided by is raised by DARK_LEVEL.
    """
    blue, green, red = cv2.split(image)
    purple = cv2.addWeighted(red, 0.5, blue, 0.5, 0)
    excess = cv2.subtract(green, purple)
    brightness = cv2.addWeighted(green, 1 / COLOURS, purple, 2 / COLOURS, DARK_LEVEL)
    return np.asarray(cv2.divide(excess, brightness, scale=FULL_SCALE * 2 / COLOURS), dtype=np.uint8)


def segment(image: Image, vegetation: Vegetation) -> Mask:
    """The vegetation of an image by Otsu's threshold, never below the profile's floor; empty on bare soil.

    image: shape (h, w, 3), uint8, blue green red. Returns shape (h, w).
    """
    index = excess_green(image)
    otsu, _ = cv2.threshold(index, 0, FULL_SCALE, cv2.THRESH_OTSU)
    threshold = max(otsu, vegetation.floor * FULL_SCALE)
    return np.asarray(cv2.threshold(index, threshold, FULL_SCALE, cv2.THRESH_BINARY)[1], dtype=np.uint8)


def find_plants(image: Image, vegetation: Vegetation, camera: Pinhole) -> tuple[Centres, Mask]:
    """The plants of an image, and its vegetation.

    Regions are found at WORKING_WIDTH_PX; those smaller than the profile's area at their place are left out,
    those taller than its limit are divided. An image that is none (one channel, tiny, not finite) holds no
    plants. The camera must be that of the image: pixels of both are the same.
    """
    colour = _as_colour(image)
    if colour is None:
        return NOTHING, np.zeros(image.shape[:2], np.uint8)
    height, width = colour.shape[:2]
    divisor = max(1, width // WORKING_WIDTH_PX)
    size = (width // divisor, height // divisor)
    small = colour if divisor == 1 else cv2.resize(colour, size, interpolation=cv2.INTER_AREA)
    mask = segment(np.asarray(small, dtype=np.uint8), vegetation)
    scale = np.array([width, height]) / size
    labels, found = of_mask(mask)
    large = _area_m2(found, scale, camera) >= vegetation.smallest_area_m2
    pieces = divide(labels, found, _sections(found, scale[1], vegetation.tallest_region_m, camera) * large)
    whole = mask if divisor == 1 else cv2.resize(mask, (width, height), interpolation=cv2.INTER_NEAREST)
    return _centres(pieces, scale), np.asarray(whole, dtype=np.uint8)


def _as_colour(image: Image) -> Image | None:
    """The image as three channels of uint8; None when it cannot be one."""
    if image.ndim != COLOURS or image.shape[2] < COLOURS or min(image.shape[:2]) < SMALLEST_SIDE_PX:
        return None
    if image.dtype != np.uint8:
        image = np.nan_to_num(image, nan=0, posinf=0, neginf=0).clip(0, FULL_SCALE).astype(np.uint8)
    return image if image.shape[2] == COLOURS else np.ascontiguousarray(image[:, :, :COLOURS])


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


NOTHING = Centres(np.empty((0, 2)), np.empty(0), np.empty(0), np.empty(0))
