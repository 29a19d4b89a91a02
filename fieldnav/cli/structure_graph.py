"""The field-structure signal as a graph whose x axis is the picture's bottom edge (paper III-A.2)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from fieldnav.messages import Image, RowLine
from fieldnav.perception.moving_variance import FieldStructure
from fieldnav.pinhole import Pinhole

HEIGHT = 0.34
"""Of the graph, over the picture's height."""
DOTS_PER_INCH = 100
WIDTH_INCH = 12.8
"""The graph is laid out at this width, whatever the picture's size, so that it always looks the same."""
HEADROOM, FLOOR = 1.18, -0.12
"""The axis reaches so many times above the signal, and so far below zero to hold the rows' marks."""
LEGEND_COLUMNS = 4


@dataclass(frozen=True, slots=True)
class Colour:
    """A colour for both libraries that draw."""

    red: int
    green: int
    blue: int

    @property
    def bgr(self) -> tuple[int, int, int]:
        return self.blue, self.green, self.red

    @property
    def hex(self) -> str:
        return f"#{self.red:02x}{self.green:02x}{self.blue:02x}"


ROW_COLOUR = Colour(255, 196, 0)
SIGNAL, PEAK, TROUGH, INK, PAPER, GRID = "#2f6db3", "#c8352b", "#2d8a3e", "#333333", "#fbfaf7", "#dddad2"


def draw_structure(structure: FieldStructure, rows: Sequence[RowLine], camera: Pinhole) -> Image:
    """The signal over the place where each window's line meets the bottom edge, its peaks, its troughs, the rows.

    Returns a picture as wide as the camera's, shape (height * HEIGHT, width, 3), blue green red.
    """
    width_px, height_px = camera.width_px, max(1, round(camera.height_px * HEIGHT))
    dots = DOTS_PER_INCH * width_px / (WIDTH_INCH * DOTS_PER_INCH)
    figure = Figure(figsize=(WIDTH_INCH, height_px / dots), dpi=dots, facecolor=PAPER)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1), facecolor=PAPER)
    _draw_signal(axes, structure)
    _draw_rows(axes, rows)
    _dress(axes, structure, camera)
    canvas.draw()
    drawn = np.asarray(canvas.buffer_rgba())[:height_px, :width_px, 2::-1]
    framed = np.full((height_px, width_px, 3), 255, np.uint8)
    framed[: drawn.shape[0], : drawn.shape[1]] = drawn
    return framed


def _draw_signal(axes: Axes, structure: FieldStructure) -> None:
    x, y = structure.intersection_px, structure.variance
    axes.plot(x, y, color=SIGNAL, linewidth=1.6, marker=".", markersize=4, label="moving variance")
    marks = ((structure.peaks, "^", PEAK, "peaks"), (structure.troughs, "v", TROUGH, "troughs"))
    for indices, marker, colour, label in marks:
        at = indices[(indices >= 0) & (indices < len(x))]
        style = {"color": colour, "markerfacecolor": PAPER, "markeredgewidth": 1.8, "markersize": 9}
        axes.plot(x[at], y[at], linestyle="none", marker=marker, label=label, zorder=3, **style)


def _draw_rows(axes: Axes, rows: Sequence[RowLine]) -> None:
    bottom = [row.x_bottom_px for row in rows]
    axes.plot(
        bottom,
        np.zeros(len(bottom)),
        linestyle="none",
        marker="s",
        markersize=9,
        color=ROW_COLOUR.hex,
        markeredgecolor=INK,
        label="rows",
        zorder=4,
    )
    for x in bottom:
        axes.axvline(x, color=ROW_COLOUR.hex, linewidth=1.5, zorder=1)


def _dress(axes: Axes, structure: FieldStructure, camera: Pinhole) -> None:
    known = structure.variance[np.isfinite(structure.variance)]
    highest = float(known.max()) if len(known) else 1.0
    axes.set_xlim(-0.5, camera.width_px - 0.5)
    axes.set_ylim(FLOOR * highest, HEADROOM * highest)
    axes.grid(axis="y", color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)
    axes.axhline(0, color=INK, linewidth=0.8)
    axes.tick_params(axis="y", direction="in", pad=-28, labelsize=9, labelcolor=INK, length=0)
    for tick in axes.get_yticklabels():
        tick.set_horizontalalignment("left")
    axes.tick_params(axis="x", length=0, labelbottom=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    title = "variance of the window lines' angles, deg2, where they meet the bottom edge"
    axes.text(0.006, 0.95, title, transform=axes.transAxes, fontsize=10, color=INK, va="top")
    axes.legend(
        loc="upper right", ncols=LEGEND_COLUMNS, fontsize=9, frameon=True, facecolor=PAPER, edgecolor=GRID
    )
