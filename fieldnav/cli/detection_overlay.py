"""A picture with its rows and plants drawn in, and the field-structure signal beneath, as in the paper's figure."""

import cv2
import numpy as np

from fieldnav.cli.pictures import Detection
from fieldnav.cli.structure_graph import ROW_COLOUR, draw_structure
from fieldnav.messages import Image, RowLine

PLANT_BGR = (230, 60, 230)
LEAF_BGR = (80, 255, 120)
SHADOW_BGR = (20, 20, 20)
"""A darker edge keeps lines and dots legible on leaves as on soil."""

WIDTH_OF_ONE_PX = 640
"""Image width at which lines are one pixel wide."""
FRACTION_BITS = 3
"""OpenCV places lines to eighths of a pixel when told so."""


def draw_detection(found: Detection) -> Image:
    """The picture, rows, leaf edges and plants drawn in, above its field-structure signal; as wide as the picture."""
    canvas = found.image.copy()
    unit = max(1, round(found.camera.width_px / WIDTH_OF_ONE_PX))
    edges, _ = cv2.findContours(found.view.mask.astype(np.uint8), cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE)
    cv2.drawContours(canvas, edges, -1, LEAF_BGR, max(1, unit // 2), cv2.LINE_AA)
    for row in found.view.lines:
        _draw_row(canvas, row, SHADOW_BGR, 3 * unit)
        _draw_row(canvas, row, ROW_COLOUR.bgr, 2 * unit)
    for x, y in found.view.centres.position_px.tolist():
        _draw_dot(canvas, (x, y), 3 * unit, SHADOW_BGR)
        _draw_dot(canvas, (x, y), 2 * unit, PLANT_BGR)
    graph = draw_structure(found.view.structure, found.view.lines, found.camera)
    return np.concatenate([canvas, graph])


def _draw_row(canvas: Image, row: RowLine, colour: tuple[int, int, int], thickness: int) -> None:
    top = (_fixed(row.x_top_px), 0)
    bottom = (_fixed(row.x_bottom_px), _fixed(canvas.shape[0] - 1))
    cv2.line(canvas, top, bottom, colour, thickness, cv2.LINE_AA, FRACTION_BITS)


def _draw_dot(canvas: Image, at: tuple[float, float], radius: int, colour: tuple[int, int, int]) -> None:
    centre = (_fixed(at[0]), _fixed(at[1]))
    cv2.circle(canvas, centre, _fixed(radius), colour, cv2.FILLED, cv2.LINE_AA, FRACTION_BITS)


def _fixed(value_px: float) -> int:
    return round(value_px * 2**FRACTION_BITS)
