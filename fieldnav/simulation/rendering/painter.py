"""Painting leaves: projected as whole arrays, then filled one after the other, far plants first."""

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.simulation.rendering.foliage import Leaves
from fieldnav.simulation.rendering.view import View
from fieldnav.simulation.rendering.wind import Wind

Canvas = NDArray[np.uint8]

NEAREST_M = 0.05  # leaves closer to the camera than this are not drawn
SMALLEST_PX = 0.6  # leaves reaching less than this from their middle are not drawn
SUBPIXEL = 3  # bits


def paint_leaves(canvas: Canvas, view: View, leaves: Leaves, wind: Wind, time_s: float) -> None:
    """Paint leaves, as numbers of colours, into `canvas`, shape (height, width), as a view sees them."""
    camera = view.position_m - np.array([*leaves.origin, 0.0])
    projection = view.projection.astype(np.float32)
    shift = (-view.projection @ camera).astype(np.float32)
    order = _visible(view, leaves, projection, shift)
    moved = wind.displacement(leaves.centre[order, 2], leaves.sway_rad[leaves.plant[order]], time_s)
    homogeneous = leaves.outline[order] @ projection.T + (moved @ projection.T + shift)[:, None]
    pixels = homogeneous[..., :2] / homogeneous[..., 2:]
    outlines = np.rint(pixels * (1 << SUBPIXEL)).astype(np.int32)
    fill = cv2.fillConvexPoly
    for outline, colour in zip(outlines, leaves.colour[order].tolist(), strict=True):
        fill(canvas, outline, colour, cv2.LINE_8, SUBPIXEL)


def _visible(
    view: View, leaves: Leaves, projection: NDArray[np.float32], shift: NDArray[np.float32]
) -> NDArray[np.int64]:
    """Indices of the leaves that touch the picture, in the order of painting: far plants first."""
    middle = leaves.centre @ projection.T + shift
    near = middle[:, 2] > NEAREST_M + leaves.reach
    depth = np.where(near, middle[:, 2], 1)
    reach = view.focal_px * leaves.reach / depth
    x, y = middle[:, 0] / depth, middle[:, 1] / depth
    across = (x > -reach) & (x < view.width_px + reach)
    along = (y > -reach) & (y < view.height_px + reach)
    seen = np.flatnonzero(near & across & along & (reach > SMALLEST_PX))
    plant_depth = leaves.top @ projection[2] + shift[2]
    rank = np.empty(len(plant_depth), np.int32)
    rank[np.argsort(-plant_depth, kind="stable")] = np.arange(len(plant_depth), dtype=np.int32)
    return seen[np.argsort(rank[leaves.plant[seen]], kind="stable")]
