"""A picture with its rows and plants drawn in, and the field-structure signal beneath, as in the paper's figure."""

from dataclasses import dataclass

import cv2
import numpy as np

from fieldnav.cli.pictures import Detection
from fieldnav.messages import Floats, Image, RowLine
from fieldnav.perception.moving_variance import FieldStructure

Colour = tuple[int, int, int]

ROW: Colour = (60, 230, 60)
LANE_ROW: Colour = (60, 200, 255)
PLANT: Colour = (230, 60, 230)
PAPER: Colour = (250, 250, 250)
GRID: Colour = (225, 225, 225)
INK: Colour = (70, 70, 70)
SIGNAL: Colour = (180, 110, 30)
UNDER_SIGNAL: Colour = (245, 225, 205)
PEAK: Colour = (40, 40, 210)
TROUGH: Colour = (50, 150, 40)
"""Blue green red: every row found, the lane's among them, plants; the graph's paper, lines, writing and marks."""

GRAPH_HEIGHT = 0.36
"""Of the graph, over the picture's height."""
WIDTH_OF_ONE_PX = 640
"""Image width at which lines are one pixel wide."""
EIGHTHS = 3
"""OpenCV draws at eighths of a pixel when told 3 bits of fraction."""


@dataclass(frozen=True, slots=True)
class _Graph:
    """The panel beneath the picture: `unit` is the line width; the signal 0 lies at `zero_px`, `top_deg2` at `top_px`."""

    canvas: Image
    unit: int
    top_px: int
    zero_px: int
    top_deg2: float

    def y_px(self, variance: Floats) -> Floats:
        return self.zero_px - np.sqrt(variance / self.top_deg2) * (self.zero_px - self.top_px)


def draw_detection(found: Detection) -> Image:
    """The picture and its graph below each other, shape (height * (1 + GRAPH_HEIGHT), width, 3)."""
    unit = max(1, round(found.camera.width_px / WIDTH_OF_ONE_PX))
    return np.concatenate([_picture(found, unit), _graph(found, unit)])


def _picture(found: Detection, unit: int) -> Image:
    canvas = found.image.copy()
    for row in found.view.lines:
        _draw_row(canvas, row, ROW, unit)
    for x, y in found.view.centres.position_px:
        _draw_dot(canvas, x, y, 2 * unit, PLANT)
    return canvas


def _draw_row(canvas: Image, row: RowLine, colour: Colour, unit: int) -> None:
    ends = [(row.x_top_px, 0.0), (row.x_bottom_px, canvas.shape[0] - 1.0)]
    first, last = (tuple(round(value * 2**EIGHTHS) for value in end) for end in ends)
    cv2.line(canvas, first, last, colour, 2 * unit, cv2.LINE_AA, EIGHTHS)


def _draw_dot(canvas: Image, x: float, y: float, radius: int, colour: Colour) -> None:
    centre = (round(x * 2**EIGHTHS), round(y * 2**EIGHTHS))
    cv2.circle(canvas, centre, radius * 2**EIGHTHS, colour, cv2.FILLED, cv2.LINE_AA, EIGHTHS)
