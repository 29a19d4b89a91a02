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
    outlines = _project(leaves.outline[order], moved, projection, shift)
    fill = cv2.fillConvexPoly
    for outline, colour in zip(outlines, leaves.colour[order].tolist(), strict=True):
        fill(canvas, outline, colour, cv2.LINE_8, SUBPIXEL)


def _project(
    outline: NDArray[np.float32],
    moved: NDArray[np.float32],
    projection: NDArray[np.float32],
    shift: NDArray[np.float32],
) -> NDArray[np.int32]:
    """Outlines (n, v, 3), each moved by (n, 3), as pixels (n, v, 2) in units of 1 / 2**SUBPIXEL."""
    count, vertices = outline.shape[:2]
    points = (projection @ outline.reshape(-1, 3).T).reshape(3, count, vertices)
    points += (projection @ moved.T + shift[:, None])[..., None]
    scale = np.float32(1 << SUBPIXEL) / points[2]
    pixels = np.empty((count, vertices, 2), np.int32)
    pixels[..., 0] = np.rint(points[0] * scale)
    pixels[..., 1] = np.rint(points[1] * scale)
    return pixels


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
