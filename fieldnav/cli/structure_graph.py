"""The field-structure signal as a graph that goes with the picture above it (paper III-A.2)."""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from fieldnav.messages import Floats, Image, RowLine
from fieldnav.perception.moving_variance import FieldStructure
from fieldnav.pinhole import Pinhole

HEIGHT = 0.19
"""Of the graph, over the picture's width."""
WIDTH_INCH = 12.8
"""The graph is laid out at this width, whatever the picture's size, so that it always looks the same."""
HEADROOM, FLOOR = 1.3, -0.12
"""The axis reaches so many times above the signal, and so far below zero to hold the rows' marks."""
LEGEND_COLUMNS, MOST_TICKS = 4, 4
MARK_SIZE, MARK_EDGE = 9.0, 1.8


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


def draw_structure(
    structure: FieldStructure, rows: Sequence[RowLine], camera: Pinhole, stride_px: float
) -> Image:
    """The signal over the windows' middles, its peaks and troughs, and where the rows pass at mid-height.

    The windows lie `stride_px` apart. Returns shape (width * HEIGHT, width, 3), blue green red.
    """
    width_px, height_px = camera.width_px, max(1, round(camera.width_px * HEIGHT))
    dots = width_px / WIDTH_INCH
    figure = Figure(figsize=(WIDTH_INCH, height_px / dots), dpi=dots, facecolor=PAPER)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1), facecolor=PAPER)
    count = len(structure.variance)
    middles_px = np.asarray(
        camera.centre_x_px + stride_px * (np.arange(count) - (count - 1) / 2), dtype=np.float64
    )
    _draw_signal(axes, middles_px, structure)
    _draw_rows(axes, [(row.x_top_px + row.x_bottom_px) / 2 for row in rows])
    _dress(axes, structure, camera)
    canvas.draw()  # type: ignore[no-untyped-call]  # matplotlib types its backends in part
    drawn = np.asarray(canvas.buffer_rgba())[:, :, 2::-1]  # type: ignore[no-untyped-call]  # the same
    return np.asarray(cv2.resize(np.ascontiguousarray(drawn), (width_px, height_px)), dtype=np.uint8)


def _draw_signal(axes: Axes, x: Floats, structure: FieldStructure) -> None:
    y = structure.variance
    axes.fill_between(x, 0, y, color=SIGNAL, alpha=0.12, linewidth=0)
    axes.plot(x, y, color=SIGNAL, linewidth=1.6, marker=".", markersize=4, label="moving variance")
    marks = ((structure.peaks, "^", PEAK, "peaks"), (structure.troughs, "v", TROUGH, "troughs"))
    for indices, marker, colour, label in marks:
        at = indices[(indices >= 0) & (indices < len(x))]
        (drawn,) = axes.plot(x[at], y[at], linestyle="none", marker=marker, label=label, zorder=3)
        drawn.set(color=colour, markerfacecolor=PAPER, markeredgewidth=MARK_EDGE, markersize=MARK_SIZE)


def _draw_rows(axes: Axes, x: Sequence[float]) -> None:
    label = "rows at mid-height"
    (drawn,) = axes.plot(x, np.zeros(len(x)), linestyle="none", marker="s", label=label, zorder=4)
    drawn.set(markersize=MARK_SIZE, markerfacecolor=ROW_COLOUR.hex, markeredgecolor=INK)
    for each in x:
        axes.axvline(each, color=ROW_COLOUR.hex, linewidth=1.5, zorder=1)


def _dress(axes: Axes, structure: FieldStructure, camera: Pinhole) -> None:
    known = structure.variance[np.isfinite(structure.variance)]
    highest = float(known.max(initial=0)) or 1.0
    axes.set_xlim(-0.5, camera.width_px - 0.5)
    axes.set_ylim(FLOOR * highest, HEADROOM * highest)
    ticks = [tick for tick in MaxNLocator(MOST_TICKS).tick_values(0, highest) if 0 < tick <= highest]
    axes.set_yticks(ticks)
    axes.grid(axis="y", color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)
    axes.axhline(0, color=INK, linewidth=0.8)
    axes.tick_params(length=0, labelbottom=False, labelleft=False)
    for tick in ticks:
        axes.annotate(f"{tick:g}", (0.006, tick), xycoords=axes.get_yaxis_transform(), color=INK, fontsize=9)
    for spine in axes.spines.values():
        spine.set_visible(False)
    title = "moving variance of the window lines' angles, deg2"
    axes.text(0.006, 0.95, title, transform=axes.transAxes, fontsize=11, color=INK, va="top")
    axes.legend(loc="upper right", ncols=LEGEND_COLUMNS, fontsize=10, facecolor=PAPER, edgecolor=GRID)
