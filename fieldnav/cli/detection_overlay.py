"""A picture with what was found drawn in, a line that says how, and the field-structure signal beneath."""

import cv2
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from fieldnav.cli.detection import Detection
from fieldnav.cli.detection_colours import LEAF_BGR, PAPER
from fieldnav.cli.overlay_caption import write_caption
from fieldnav.cli.row_curves import draw_found
from fieldnav.cli.structure_graph import draw_structure
from fieldnav.messages import Image

LEAST_WIDTH_PX, MOST_WIDTH_PX, MOST_HEIGHT_PX = 1280, 1920, 2400
"""Pictures outside these are shown larger or smaller, so that the writing can be read and the whole seen."""
WIDTH_INCH = 12.8
"""The overlay is laid out at this width, whatever the picture's size, so that it always looks the same."""
CAPTION_HEIGHT, GRAPH_HEIGHT = 0.042, 0.17
"""Over the width."""
ROUNDING_PX = 0.01
"""Added to a figure's sides, since Matplotlib rounds what the division left down."""
PALE = 0.55
"""Of its colour the ground loses so much, that leaves, rows and plants stand out."""
TINT = 0.4
"""Of the tint where vegetation is strongest."""
FULL_SCALE = 255


def draw_detection(found: Detection) -> Image:
    """The overlay, shape (height, width, 3), blue green red; the picture is its upper part."""
    picture = _shown(found)
    height_px, width_px = picture.shape[:2]
    caption_px, graph_px = (max(1, round(share * width_px)) for share in (CAPTION_HEIGHT, GRAPH_HEIGHT))
    whole_px, dots = height_px + caption_px + graph_px, width_px / WIDTH_INCH
    size = ((width_px + ROUNDING_PX) / dots, (whole_px + ROUNDING_PX) / dots)
    figure = Figure(figsize=size, dpi=dots, facecolor=PAPER)
    canvas = FigureCanvasAgg(figure)
    graph = figure.add_axes((0, 0, 1, graph_px / whole_px))
    caption = figure.add_axes((0, graph_px / whole_px, 1, caption_px / whole_px))
    above = figure.add_axes((0, (graph_px + caption_px) / whole_px, 1, height_px / whole_px))
    edges = (-0.5, found.width_px - 0.5, found.height_px - 0.5, -0.5)
    above.imshow(picture[:, :, ::-1], extent=edges, aspect="auto", interpolation="nearest")
    draw_found(above, found)
    above.set_axis_off()
    above.set(xlim=edges[:2], ylim=edges[2:])
    write_caption(caption, found)
    draw_structure(graph, found)
    graph.set_xlim(*edges[:2])
    canvas.draw()  # type: ignore[no-untyped-call]  # matplotlib types its backends in part
    drawn = np.asarray(canvas.buffer_rgba())[:, :, 2::-1]  # type: ignore[no-untyped-call]  # the same
    return np.ascontiguousarray(drawn, dtype=np.uint8)


def _shown(found: Detection) -> Image:
    """The picture at a size fit to look at, its ground paler and its vegetation tinted."""
    width = min(max(found.width_px, LEAST_WIDTH_PX), MOST_WIDTH_PX)
    scale = min(width / found.width_px, MOST_HEIGHT_PX / found.height_px)
    size = (max(1, round(found.width_px * scale)), max(1, round(found.height_px * scale)))
    way = cv2.INTER_CUBIC if scale > 1 else cv2.INTER_AREA
    picture = np.asarray(cv2.resize(found.image, size, interpolation=way), np.float32)
    strength = cv2.resize(found.view.cover.strength, size, interpolation=cv2.INTER_LINEAR)
    strong = np.sqrt(np.asarray(strength, np.float32)[:, :, None] / FULL_SCALE)
    grey = picture.mean(axis=2, keepdims=True)
    pale = picture + PALE * (1 - strong) * (grey - picture)
    tinted = pale + TINT * strong * (LEAF_BGR - pale)
    return np.asarray(tinted.clip(0, FULL_SCALE), np.uint8)
