"""Telling a new crop row from the one known, by SIFT features in its parallelogram (paper III-C)."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats, Image, RowLine
from fieldnav.perception.canopy import half_width_px, line_px
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

MOST_FEATURES = 150
FEWEST_FEATURES = 8  # fewer in either set say nothing about the row
WORKING_WIDTH_PX = 640  # features are taken at this width of the image or just above
WIDER = 1.6  # strip against the row's parallelogram: leaves reach over it
SMALLEST_SIDE_PX = 16  # of the strip, at the working size; SIFT needs a few octaves
LINEAR_INDEX = 0  # FLANN's exhaustive search: exact, and the same twice; a few hundred features need no tree
FULL = 255


@dataclass(frozen=True, slots=True)
class Descriptors:
    """SIFT features of a row: vectors, shape (n, 128), float32, and where they were, shape (n, 2), pixels."""

    vectors: NDArray[np.float32]
    position_px: Floats

    def __len__(self) -> int:
        return len(self.vectors)


def describe(
    image: Image,
    row: RowLine,
    crop: CropProfile,
    camera: Pinhole,
    top_px: float = 0.0,
    bottom_px: float | None = None,
) -> Descriptors:
    """SIFT features inside a row's parallelogram between two image rows; none where it leaves the image.

    image: shape (h, w, 3), uint8, blue green red.
    """
    last = camera.height_px - 1.0 if bottom_px is None else bottom_px
    ends = np.array([max(top_px, 0.0), min(last, camera.height_px - 1.0)])
    half = half_width_px(ends, crop, camera) * WIDER
    middle = line_px(row, ends, camera)
    corners = np.array(
        [
            [middle[0] - half[0], ends[0]],
            [middle[0] + half[0], ends[0]],
            [middle[1] + half[1], ends[1]],
            [middle[1] - half[1], ends[1]],
        ]
    )
    left, upper = np.floor(corners.min(axis=0)).clip(0).astype(int)
    right, lower = np.ceil(corners.max(axis=0)).astype(int) + 1
    strip = image[upper:lower, left : max(right, 0)]
    divisor = max(1, camera.width_px // WORKING_WIDTH_PX)
    if min(strip.shape[:2]) < SMALLEST_SIDE_PX * divisor:
        return NOTHING
    return _features(strip, corners - [left, upper], np.array([left, upper]), divisor)


def distance(reference: Descriptors, candidate: Descriptors, match_ratio: float) -> float | None:
    """Mean Euclidean distance of the best matches, those above `match_ratio` (paper eq. 2, lambda).

    Each feature of the candidate is matched with the nearest of the reference. None when either has too few.
    """
    if min(len(reference), len(candidate)) < FEWEST_FEATURES:
        return None
    matcher = cv2.FlannBasedMatcher({"algorithm": LINEAR_INDEX}, {})
    matches = matcher.match(candidate.vectors, reference.vectors)
    found = np.array([match.distance for match in matches])
    above = found[found > match_ratio]
    return float(above.mean()) if len(above) else 0.0


def _features(strip: Image, corners: Floats, origin: Floats, divisor: int) -> Descriptors:
    """Features of a strip inside a parallelogram of it; origin: the strip's place in the image."""
    grey = cv2.cvtColor(strip, cv2.COLOR_BGR2GRAY)
    size = (grey.shape[1] // divisor, grey.shape[0] // divisor)
    small = cv2.resize(grey, size, interpolation=cv2.INTER_AREA)
    mask = np.zeros(small.shape, np.uint8)
    cv2.fillConvexPoly(mask, np.round(corners / divisor).astype(np.int32), FULL)
    keypoints, vectors = cv2.SIFT.create(nfeatures=MOST_FEATURES).detectAndCompute(small, mask)
    if vectors is None or not len(keypoints):
        return NOTHING
    place = np.array([keypoint.pt for keypoint in keypoints], float)
    return Descriptors(np.asarray(vectors, np.float32), (place + 0.5) * divisor - 0.5 + origin)


NOTHING = Descriptors(np.empty((0, 128), np.float32), np.empty((0, 2)))
