"""Telling a new crop row from the one known, by SIFT features in its parallelogram (paper III-C)."""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats, Image, RowLine
from fieldnav.perception.canopy import canopy_plane, half_width_px, line_px
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

MOST_FEATURES = 250
FEWEST_FEATURES = 8  # fewer in either set say nothing about the row
WORKING_WIDTH_PX = 640  # features are taken at this width of the image or just above
WIDER = 1.6  # strip against the row's parallelogram: leaves reach over it
LEAST_CONTRAST = (
    0.02  # half of SIFT's usual; under a dull sky the soil's clods have little, and they stay put
)
LEAST_WIDTH_M = 0.24  # of the strip: thin rows look alike, the ground beside them does not
SMALLEST_SIDE_PX = 16  # of the strip, at the working size; SIFT needs a few octaves
LINEAR_INDEX = 0  # FLANN's exhaustive search: exact, and the same twice; a few hundred features need no tree
FULL = 255


@dataclass(frozen=True, slots=True)
class Descriptors:
    """SIFT features of a row: vectors, shape (n, 128), float32, and where they were, shape (n, 2), pixels.

    ground_m: shape (n, 2), the same on the plane through the canopy, ahead of and left of the robot's centre;
    beside_m: shape (n,), how far left of the row's line; angle_deg, size_px: shape (n,), of each feature.
    """

    vectors: NDArray[np.float32]
    position_px: Floats
    ground_m: Floats
    beside_m: Floats
    angle_deg: Floats
    size_px: Floats

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
    ends = np.array([max(top_px, camera.top_px), min(last, camera.height_px - 1.0)])
    corners = _strip_corners(row, ends, crop, camera)
    left, upper = np.floor(corners.min(axis=0)).clip(0).astype(int)
    right, lower = np.ceil(corners.max(axis=0)).astype(int) + 1
    strip = image[upper:lower, left : max(right, 0)]
    divisor = max(1, camera.width_px // WORKING_WIDTH_PX)
    if min(strip.shape[:2]) < SMALLEST_SIDE_PX * divisor:
        return NOTHING
    keypoints, vectors = _features(strip, corners - [left, upper], divisor)
    if vectors is None or not len(keypoints):
        return NOTHING
    place = np.array([keypoint.pt for keypoint in keypoints], float)
    position_px = (place + 0.5) * divisor - 0.5 + [left, upper]
    plane = canopy_plane(camera, crop)
    offset_m, slope = plane.row_on_ground(row)
    ground_m = plane.to_ground(position_px)
    return Descriptors(
        vectors,
        position_px,
        ground_m,
        ground_m[:, 1] - offset_m - slope * ground_m[:, 0],
        np.array([keypoint.angle for keypoint in keypoints]),
        np.array([keypoint.size for keypoint in keypoints]) * divisor,
    )


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


def _strip_corners(row: RowLine, ends_px: Floats, crop: CropProfile, camera: Pinhole) -> Floats:
    """Corners, shape (4, 2), pixels, of the strip along a row between two image rows."""
    across = canopy_plane(camera, crop).pixels_per_metre(ends_px)
    half = np.maximum(half_width_px(ends_px, crop, camera) * WIDER, LEAST_WIDTH_M / 2 * across)
    middle = line_px(row, ends_px, camera)
    right, left = (np.stack([middle + side * half, ends_px], axis=-1) for side in (1, -1))
    return np.concatenate([right, left[::-1]])


def _features(
    strip: Image, corners: Floats, divisor: int
) -> tuple[Sequence[cv2.KeyPoint], NDArray[np.float32] | None]:
    """Features inside a parallelogram of a strip, in pixels of the strip made smaller by the divisor."""
    grey = cv2.cvtColor(strip, cv2.COLOR_BGR2GRAY)
    size = (grey.shape[1] // divisor, grey.shape[0] // divisor)
    small = cv2.resize(grey, size, interpolation=cv2.INTER_AREA)
    mask = np.zeros(small.shape, np.uint8)
    cv2.fillConvexPoly(mask, np.round(corners / divisor).astype(np.int32), FULL)
    sift = cv2.SIFT.create(nfeatures=MOST_FEATURES, contrastThreshold=LEAST_CONTRAST)
    keypoints, vectors = sift.detectAndCompute(small, mask)
    return keypoints, None if vectors is None else np.asarray(vectors, np.float32)


NOTHING = Descriptors(
    np.empty((0, 128), np.float32),
    np.empty((0, 2)),
    np.empty((0, 2)),
    np.empty(0),
    np.empty(0),
    np.empty(0),
)
