"""Whether a picture can show anything at all: its brightness, contrast and sharpness, and how two differ."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Image

THUMBNAIL_PX = (64, 36)
"""Width and height at which pictures are compared: sensor noise is gone, every plant still there."""

COARSE_SD = 3.0
"""Thumbnail's pixels: what varies more slowly is light."""

DETAIL_ROWS = 180
"""About so many rows of a picture are looked at for its detail: noise is averaged out as well."""

BLACK, WHITE = 10.0, 245.0
"""Grey levels of mean brightness; a field by night is darker, a sensor in the sun brighter."""


@dataclass(frozen=True, slots=True)
class PictureQuality:
    """brightness: mean, contrast: standard deviation, both in grey levels of 0 to 255; sharpness: variance of
    the Laplacian of the grey picture at its own size.
    """

    brightness: float
    contrast: float
    sharpness: float


def quality(image: Image) -> PictureQuality:
    """The quality of a picture, shape (height, width, 3), blue green red."""
    grey = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    mean, deviation = cv2.meanStdDev(grey)
    edges = cv2.Laplacian(grey, cv2.CV_32F)
    return PictureQuality(float(mean[0, 0]), float(deviation[0, 0]), float(edges.var()))


def difference(one: Image, other: Image) -> float:
    """Mean difference of two pictures of any sizes in grey levels, sensor noise left out."""
    small = [cv2.resize(each, THUMBNAIL_PX, interpolation=cv2.INTER_AREA) for each in (one, other)]
    return float(cv2.absdiff(*small).mean())


def same(one: Image, other: Image) -> bool:
    """Whether two pictures are one: a sensor's noise never comes twice."""
    return one.shape == other.shape and bool(np.array_equal(one, other))


def same_share(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> float:
    """The share of values that two samples of pictures have in common; 0 for different sizes."""
    return np.count_nonzero(one == other) / one.size if one.shape == other.shape else 0.0


def detail(image: Image) -> float:
    """How much can be told apart in a picture: standard deviation in grey levels, uneven light and noise left
    out, in the channel that has most.
    """
    rows = image[:: max(1, len(image) // DETAIL_ROWS)]
    small = cv2.resize(rows, THUMBNAIL_PX, interpolation=cv2.INTER_AREA).astype(np.float32)
    fine = small - cv2.GaussianBlur(small, (0, 0), COARSE_SD)
    return float(cv2.meanStdDev(fine)[1].max())
