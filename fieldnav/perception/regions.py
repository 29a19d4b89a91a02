"""Connected regions of a mask, and the division of tall ones into horizontal sections (paper III-A.1)."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats

CONNECTIVITY = 4  # regions that touch by a corner only are two


@dataclass(frozen=True, slots=True)
class Regions:
    """Regions of an image, arrays of shape (n,), in pixels: area, centre of mass, first and last row."""

    area: Floats
    x: Floats
    y: Floats
    top: Floats
    bottom: Floats


def of_mask(mask: NDArray[np.uint8]) -> tuple[NDArray[np.int32], Regions]:
    """The regions of a mask, shape (h, w), and its labels, shape (h, w): 0 background, i + 1 region i."""
    _, labels, stats, centroids = cv2.connectedComponentsWithStats(
        mask, connectivity=CONNECTIVITY, ltype=cv2.CV_32S
    )
    numbers, centre = np.asarray(stats[1:], np.float64), np.asarray(centroids[1:], np.float64)
    top, area = numbers[:, cv2.CC_STAT_TOP], numbers[:, cv2.CC_STAT_AREA]
    bottom = top + numbers[:, cv2.CC_STAT_HEIGHT] - 1
    return np.asarray(labels, np.int32), Regions(area, centre[:, 0], centre[:, 1], top, bottom)


def divide(labels: NDArray[np.int32], found: Regions, sections: NDArray[np.int64]) -> Regions:
    """Cut each region into so many sections of equal height; 0 leaves it out.

    labels: as `of_mask` gives them; sections: shape (n,). A section without a pixel is left out.
    """
    whole = sections == 1
    kept = Regions(*(getattr(found, name)[whole] for name in Regions.__slots__))
    tall = np.flatnonzero(sections > 1)
    if not tall.size:
        return kept
    pieces = _cut(labels, found, sections, tall)
    return Regions(
        *(np.concatenate([getattr(kept, name), getattr(pieces, name)]) for name in Regions.__slots__)
    )


def _cut(
    labels: NDArray[np.int32], found: Regions, sections: NDArray[np.int64], tall: NDArray[np.int64]
) -> Regions:
    """The sections of the regions `tall`, by counting pixels under a number each section gets."""
    counts = sections[tall]
    first = np.full(len(sections) + 1, -1)
    first[tall + 1] = np.concatenate([[0], np.cumsum(counts)[:-1]])
    pixel = np.flatnonzero(labels != 0)  # four times as fast as on the numbers themselves
    label = labels.ravel()[pixel]
    wanted = first[label] >= 0
    pixel, label = pixel[wanted], label[wanted]
    y, x = np.divmod(pixel, labels.shape[1])
    top, height = found.top[label - 1], found.bottom[label - 1] - found.top[label - 1] + 1
    number = first[label] + ((y - top) * sections[label - 1] / height).astype(np.int64)
    size = int(counts.sum())
    area = np.bincount(number, minlength=size).astype(float)
    with np.errstate(invalid="ignore"):
        centre_x = np.bincount(number, x, size) / area
        centre_y = np.bincount(number, y, size) / area
    owner = np.repeat(tall, counts)
    place = np.arange(size) - first[owner + 1]
    step = (found.bottom[owner] - found.top[owner] + 1) / sections[owner]
    upper = found.top[owner] + place * step
    pieces = Regions(area, centre_x, centre_y, np.ceil(upper), np.ceil(upper + step) - 1)
    return Regions(*(getattr(pieces, name)[area > 0] for name in Regions.__slots__))
