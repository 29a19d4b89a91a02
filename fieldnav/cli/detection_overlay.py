"""A picture with its rows and plants drawn in, and the field-structure signal beneath (paper III-A.2)."""

from dataclasses import replace
from math import ceil

import cv2
import numpy as np

from fieldnav.cli.pictures import Detection
from fieldnav.cli.structure_graph import ROW_COLOUR, draw_structure
from fieldnav.messages import Floats, Image, RowLine

PLANT_BGR = (230, 60, 230)
LEAF_BGR = (80, 255, 120)
SHADOW_BGR = (20, 20, 20)
"""A darker edge keeps lines and dots legible on leaves as on soil."""

WIDTH_OF_ONE_PX = 640
"""Image width at which lines are one pixel wide."""
LEAST_WIDTH_PX = 960
"""Smaller pictures are shown so many whole times larger that the graph can be read."""
HALF = 0.5
FRACTION_BITS = 3
"""OpenCV places lines to eighths of a pixel when told so."""


def draw_detection(found: Detection) -> Image:
    """The picture with rows, leaf edges and plants drawn in, above its field-structure signal."""
    times = ceil(LEAST_WIDTH_PX / found.camera.width_px)
    canvas = _enlarged(found.image, times)
    unit = max(1, round(canvas.shape[1] / WIDTH_OF_ONE_PX))
    mask = _enlarged(found.view.mask.astype(np.uint8), times)
    edges, _ = cv2.findContours(mask, cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE)
    cv2.drawContours(canvas, edges, -1, LEAF_BGR, max(1, unit // 2), cv2.LINE_AA)
    lines = [_moved(row, times) for row in found.view.lines]
    for row in lines:
        _draw_row(canvas, row, SHADOW_BGR, 3 * unit)
        _draw_row(canvas, row, ROW_COLOUR.bgr, 2 * unit)
    for x, y in _centre_px(found.view.centres.position_px, times).tolist():
        _draw_dot(canvas, (x, y), 3 * unit, SHADOW_BGR)
        _draw_dot(canvas, (x, y), 2 * unit, PLANT_BGR)
    camera = replace(found.camera, width_px=canvas.shape[1], height_px=canvas.shape[0])
    graph = draw_structure(found.view.structure, lines, camera, found.stride_px * times)
    return np.concatenate([canvas, graph])


def _enlarged(image: Image, times: int) -> Image:
    """Every pixel `times` wide and high."""
    return np.ascontiguousarray(image.repeat(times, axis=0).repeat(times, axis=1))


def _centre_px(place_px: Floats, times: int) -> Floats:
    """Where a place of the picture lies in the enlarged one; pixels count from the middle of the first."""
    return (place_px + HALF) * times - HALF


def _moved(row: RowLine, times: int) -> RowLine:
    top, bottom = _centre_px(np.array([row.x_top_px, row.x_bottom_px]), times).tolist()
    return RowLine(top, bottom, row.confidence)


def _draw_row(canvas: Image, row: RowLine, colour: tuple[int, int, int], thickness: int) -> None:
    top = (_fixed(row.x_top_px), 0)
    bottom = (_fixed(row.x_bottom_px), _fixed(canvas.shape[0] - 1))
    cv2.line(canvas, top, bottom, colour, thickness, cv2.LINE_AA, FRACTION_BITS)


def _draw_dot(canvas: Image, at: tuple[float, float], radius: int, colour: tuple[int, int, int]) -> None:
    centre = (_fixed(at[0]), _fixed(at[1]))
    cv2.circle(canvas, centre, _fixed(radius), colour, cv2.FILLED, cv2.LINE_AA, FRACTION_BITS)


def _fixed(value_px: float) -> int:
    return round(value_px * (1 << FRACTION_BITS))
