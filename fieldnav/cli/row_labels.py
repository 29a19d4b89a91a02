"""The confidence beside each row, where there is room for it."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from fieldnav.cli.detection_colours import edged, of_confidence
from fieldnav.messages import Floats

FONT_SIZE, EDGE = 10.5, 3.0
"""Points."""
WIDTH, HEIGHT, GAP = 0.032, 0.018, 0.007
"""Of a label and of the space before it, over the picture's width."""
LOWEST, HIGHEST, STEPS = 0.95, 0.35, 13
"""Image rows that are tried over the picture's height, the lowest first: rows lie apart there."""


def label_rows(
    axes: Axes, curves: Sequence[Floats], confidences: Sequence[float], width_px: int, height_px: int
) -> None:
    """Write each row's confidence to the right of its curve, or to the left, or not at all.

    curves: shape (points, 2) each, from the upper end to the lower, left to right.
    """
    if not curves:
        return
    levels = np.linspace(LOWEST, HIGHEST, STEPS) * (height_px - 1)
    x = np.stack([np.interp(levels, curve[:, 1], curve[:, 0]) for curve in curves])
    for row, confidence in enumerate(confidences):
        place = _room(x, row, width_px)
        if place is not None:
            step, to_right = place
            axes.text(
                x[row, step] + (GAP if to_right else -GAP) * width_px,
                levels[step],
                f"{confidence:.2f}",
                ha="left" if to_right else "right",
                va="center",
                color=of_confidence(confidence),
                fontsize=FONT_SIZE,
                fontweight="bold",
                path_effects=edged(EDGE),
                zorder=6,
            )


def _room(x: Floats, row: int, width_px: int) -> tuple[int, bool] | None:
    """The lowest step at which a row's label fits beside it, and whether that is to its right.

    A label lies between its row and the next, so it meets no other label when each keeps to one side of a
    gap; to its left only the first row is written, and one whose right side is out of the picture.
    """
    needed, last = (WIDTH + 2 * GAP) * width_px, width_px - 1
    inside = (x[row] >= 0) & (x[row] <= last)
    right = x[row + 1] if row + 1 < len(x) else np.full(x.shape[1], np.inf)
    left = x[row - 1] + needed if row else np.full(x.shape[1], -np.inf)
    to_right = inside & (np.minimum(right, last) - x[row] >= needed)
    to_left = inside & (x[row] - np.maximum(left, 0) >= needed)
    for to_the_right, fits in ((True, to_right), (False, to_left)):
        steps = np.flatnonzero(fits)
        if len(steps):
            return int(steps[0]), to_the_right
    return None
