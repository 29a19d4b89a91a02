"""Where vegetation is: excess green and Otsu's threshold (paper III-A.1)."""

from dataclasses import dataclass
from math import ceil

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Image
from fieldnav.settings.crop import Vegetation

Mask = NDArray[np.uint8]
"""Shape (height, width): 255 where there is vegetation, 0 elsewhere."""

FULL_SCALE = 255  # grey level that stands for an index of 1
COLOURS = 3
DARK_LEVEL = 26.0  # grey levels added to the brightness, so that sensor noise in the dark is not called green
WORKING_WIDTH_PX = (
    640  # vegetation is found at this width or just above: centres of mass lose no accuracy there
)
SMALLEST_SIDE_PX = 48  # an image less wide or high holds no rows that could be told from noise
STRIPS = 12  # of an image's height, each with its own threshold for the strength of vegetation
FAINT, LUSH = 0.45, 3.0  # times the threshold: where vegetation begins to count, and where it counts in full


@dataclass(frozen=True, slots=True)
class Cover:
    """The vegetation of an image, at a size near WORKING_WIDTH_PX.

    index: excess green, shape (h, w), uint8, 255 standing for 1; threshold: the grey level from which on a
    pixel is vegetation; floor: the least it may be; width_px, height_px: size of the image itself; top: the
    first row of the index that shows ground, above which nothing is vegetation.
    """

    index: NDArray[np.uint8]
    threshold: float
    floor: float
    width_px: int
    height_px: int
    top: int = 0

    @property
    def mask(self) -> Mask:
        """Vegetation at the working size."""
        return np.asarray(cv2.threshold(self.index, self.threshold, FULL_SCALE, cv2.THRESH_BINARY)[1])

    @property
    def strength(self) -> NDArray[np.uint8]:
        """How surely and how densely each pixel is vegetation, 0 to 255, at the working size.

        Judged strip by strip: green fields at the horizon would hide pale plants nearby. Half the floor is
        enough here, since rows are told by their order too.
        """
        ground = self.index[self.top :]
        strips = np.array_split(ground, min(STRIPS, len(ground)))
        strength = np.concatenate([_strength(strip, self.floor / 2) for strip in strips])
        return strength if not self.top else np.concatenate([np.zeros_like(self.index[: self.top]), strength])

    @property
    def ground_share(self) -> float:
        """Of the image's height, that shows ground."""
        return 1 - self.top / len(self.index)

    def below(self, top_px: float) -> "tuple[Cover, float]":
        """The part of the image from about an image row on down, as if it were all, and where it begins."""
        if not top_px:
            return self, 0.0
        scale = self.height_px / len(self.index)
        top = _first_row(top_px, scale, len(self.index))
        height_px = round((len(self.index) - top) * scale)
        part = Cover(self.index[top:], self.threshold, self.floor, self.width_px, height_px)
        return part, self.height_px - float(height_px)


def _first_row(top_px: float, scale: float, rows: int) -> int:
    """The first row of a smaller image that shows nothing above an image row; at least one row is left."""
    return min(max(0, ceil((top_px + 0.5) / scale - 0.5)), rows - 1)


def _strength(strip: NDArray[np.uint8], floor: float) -> NDArray[np.uint8]:
    otsu, _ = cv2.threshold(strip, 0, FULL_SCALE, cv2.THRESH_OTSU)
    grey = np.arange(FULL_SCALE + 1) / max(otsu, floor, 1.0)
    table = (grey - FAINT) / (LUSH - FAINT) * FULL_SCALE
    return np.asarray(cv2.LUT(strip, table.clip(0, FULL_SCALE).astype(np.uint8)), np.uint8)


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


def vegetation_of(image: Image, vegetation: Vegetation, top_px: float = 0.0) -> Cover:
    """The vegetation of an image, by Otsu's threshold but never below the profile's floor.

    image: shape (h, w, 3), uint8, blue green red. One that is none (one channel, tiny, not finite) has
    nothing growing in it. top_px: the image row from which on down it shows ground; the sky and the trees
    above it have no part in the threshold.
    """
    colour = as_colour(image)
    if colour is None:
        height, width = (*image.shape, 0, 0)[:2]
        return Cover(np.zeros((1, 1), np.uint8), FULL_SCALE, FULL_SCALE, width, height)
    height, width = colour.shape[:2]
    divisor = max(1, width // WORKING_WIDTH_PX)
    size = (width // divisor, max(1, height // divisor))
    small = colour if divisor == 1 else cv2.resize(colour, size, interpolation=cv2.INTER_AREA)
    index = excess_green(np.asarray(small, dtype=np.uint8))
    top = _first_row(top_px, height / len(index), len(index)) if top_px else 0
    index[:top] = 0
    otsu, _ = cv2.threshold(index[top:], 0, FULL_SCALE, cv2.THRESH_OTSU)
    floor = vegetation.floor * FULL_SCALE
    return Cover(index, max(otsu, floor, 1.0), floor, width, height, top)


def as_colour(image: Image) -> Image | None:
    """The image as three channels of uint8; None when it cannot be one."""
    if image.ndim != COLOURS or image.shape[2] < COLOURS or min(image.shape[:2]) < SMALLEST_SIDE_PX:
        return None
    if image.dtype != np.uint8:
        image = np.nan_to_num(image, nan=0, posinf=0, neginf=0).clip(0, FULL_SCALE).astype(np.uint8)
    return image if image.shape[2] == COLOURS else np.ascontiguousarray(image[:, :, :COLOURS])
