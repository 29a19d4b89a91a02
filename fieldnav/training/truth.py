"""The truth of a drawn image: where its rows' centres lie, and where nobody can say.

The heat map has half the image's size. Rows too close to be told apart are neither rows nor ground: those
pixels are not judged.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.training.canvas import HEIGHT_PX, WIDTH_PX, Coverage
from fieldnav.training.ground_camera import Floats

Heat = NDArray[np.uint8]
"""Shape (HEAT_HEIGHT_PX, HEAT_WIDTH_PX): 255 on a row's centre, 0 away from the rows."""
Ignored = NDArray[np.bool_]
"""Shape (HEAT_HEIGHT_PX, HEAT_WIDTH_PX): the pixels that are not judged."""

REDUCTION = 2
HEAT_WIDTH_PX, HEAT_HEIGHT_PX = WIDTH_PX // REDUCTION, HEIGHT_PX // REDUCTION
FULL_HEAT = 255

SUBPIXEL_BITS = 4  # lines are placed to a sixteenth of a pixel
SUBPIXELS = 1 << SUBPIXEL_BITS
MAX_SUBPIXELS = 30_000  # OpenCV's lines overflow beyond
MIN_SPACING_PX = 3.2  # heat pixels between two rows; closer ones melt into one
MIN_IGNORED_PX = 2  # thickness of the lines of rows that are closer
LINE_BLUR_PX, LINE_PEAK = 0.8, 0.42  # blur of a line one pixel thick, and what it leaves of its height
MAX_IGNORED_HEAT = 0.3  # a row that can be told is judged where a farther one begins

CROWD_PX = (11, 3)  # width and height of the window in which crowded rows are recognised
CROWDED_HEAT = 0.36  # mean heat of rows about five pixels apart
CROWD_MARGIN_PX = (3, 5)  # height and width by which crowded regions grow


@dataclass(frozen=True, slots=True)
class RowCourse:
    """The centre of a row on the canvas, from near to far, arrays of shape (n,).

    spacing_px: how many pixels apart rows are at that place.
    """

    x_px: Floats
    y_px: Floats
    spacing_px: Floats


def no_rows() -> tuple[Heat, Ignored]:
    """The truth of an image without rows, all of it judged."""
    shape = HEAT_HEIGHT_PX, HEAT_WIDTH_PX
    return np.zeros(shape, np.uint8), np.zeros(shape, np.bool_)


def truth_of_rows(rows: list[RowCourse], hidden: Coverage) -> tuple[Heat, Ignored]:
    """Heat and ignored pixels of these rows where nothing hides them."""
    lines = np.zeros((HEAT_HEIGHT_PX, HEAT_WIDTH_PX), np.float32)
    dense = np.zeros(lines.shape, np.uint8)
    for row in rows:
        _draw_row(row, lines, dense)
    visible = 1 - cv2.resize(hidden, (HEAT_WIDTH_PX, HEAT_HEIGHT_PX), interpolation=cv2.INTER_AREA)
    share = np.clip(cv2.GaussianBlur(lines, (0, 0), LINE_BLUR_PX) / LINE_PEAK, 0, 1) * visible
    heat = (share * FULL_HEAT).astype(np.uint8)
    return heat, (dense > 0) & (share < MAX_IGNORED_HEAT) | _crowded(heat)


def _draw_row(row: RowCourse, lines: NDArray[np.float32], dense: NDArray[np.uint8]) -> None:
    """Draw the part of a row that can be told from its neighbours into `lines`, the rest into `dense`."""
    points = (np.stack([row.x_px, row.y_px], axis=-1) / REDUCTION * SUBPIXELS).astype(np.int32)
    segments = np.stack([points[:-1], points[1:]], axis=1)
    spacing = row.spacing_px[:-1] / REDUCTION
    drawable = (np.abs(segments) <= MAX_SUBPIXELS).all(axis=(1, 2))
    apart = drawable & (spacing >= MIN_SPACING_PX)
    cv2.polylines(lines, list(segments[apart]), False, 1.0, 1, cv2.LINE_8, SUBPIXEL_BITS)
    for segment, spacing_px in zip(segments[drawable & ~apart], spacing[drawable & ~apart], strict=True):
        thickness = max(MIN_IGNORED_PX, int(spacing_px) + 1)
        cv2.polylines(dense, [segment], False, 1, thickness, cv2.LINE_8, SUBPIXEL_BITS)


def _crowded(heat: Heat) -> Ignored:
    """Where rows are closer than about five pixels: they are recognised as dense, not one by one."""
    mean = cv2.blur(heat.astype(np.float32) / FULL_HEAT, CROWD_PX)
    crowded = (mean > CROWDED_HEAT).astype(np.uint8)
    return cv2.dilate(crowded, np.ones(CROWD_MARGIN_PX, np.uint8)) > 0
