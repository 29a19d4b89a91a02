"""The field-structure signal as a graph that goes with the picture above it (paper III-A.2)."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from fieldnav.cli.detection import Detection
from fieldnav.cli.detection_colours import (
    GRID,
    INK,
    PAPER,
    PEAK,
    SHADOW,
    SIGNAL,
    TROUGH,
    edged,
    of_confidence,
)
from fieldnav.cli.row_curves import crossings_px, draw_marks
from fieldnav.messages import Floats
from fieldnav.perception.moving_variance import FieldStructure, field_structure

HEADROOM, FLOOR = 1.42, -0.14
"""The axis reaches so many times above the signal, for writing, and so far below zero, for the rows."""
LEGEND_COLUMNS, MOST_TICKS = 4, 3
MARK_SIZE, MARK_EDGE, LINE, THIN = 7.5, 1.6, 1.6, 0.8
FONT_SIZE, TICK_SIZE = 9.5, 8.5
INSET, UPPER = 0.006, 0.95
"""Of the axes' width and height: where the writing begins."""


def draw_structure(axes: Axes, found: Detection) -> None:
    """The signal over the windows' middles, its peaks and troughs, and where the rows pass at mid-height.

    The axes' x is the picture's, in pixels.
    """
    _clear(axes)
    if found.camera is None:
        _write_title(axes, "field structure: not known without plants, nor those without the camera")
        return
    structure = field_structure(found.view.centres, found.finding, found.camera)
    highest = _highest(structure.variance)
    axes.set_ylim(FLOOR * highest, HEADROOM * highest)
    _draw_signal(axes, _middles_px(len(structure.variance), found), structure)
    _draw_rows(axes, found, highest)
    _draw_scale(axes, highest)
    _write_title(axes, "field structure: moving variance of the window lines' angle, deg²")
    axes.legend(loc="upper right", ncols=LEGEND_COLUMNS, fontsize=FONT_SIZE, frameon=False, borderaxespad=0.3)


def _highest(variance: Floats) -> float:
    return float(variance[np.isfinite(variance)].max(initial=0)) or 1.0


def _middles_px(count: int, found: Detection) -> Floats:
    """The middles of so many windows."""
    from_middle = np.arange(count) - (count - 1) / 2
    return np.asarray((found.width_px - 1) / 2 + found.finding.stride * found.width_px * from_middle)


def _draw_signal(axes: Axes, x: Floats, structure: FieldStructure) -> None:
    y = structure.variance
    axes.fill_between(x, 0, y, color=SIGNAL, alpha=0.12, linewidth=0)
    axes.plot(x, y, color=SIGNAL, linewidth=LINE, label="moving variance")
    marks = ((structure.peaks, "^", PEAK, "peak"), (structure.troughs, "v", TROUGH, "trough"))
    for indices, marker, colour, label in marks:
        at = indices[(indices >= 0) & (indices < len(x))]
        (drawn,) = axes.plot(x[at], y[at], linestyle="none", marker=marker, label=label, zorder=3)
        drawn.set(color=colour, markerfacecolor=PAPER, markeredgewidth=MARK_EDGE, markersize=MARK_SIZE)


def _draw_rows(axes: Axes, found: Detection, highest: float) -> None:
    x = crossings_px(found)
    for place, row in zip(x.tolist(), found.view.lines, strict=True):
        colour = of_confidence(row.confidence)
        (line,) = axes.plot([place, place], [0, highest], color=colour, linewidth=LINE, zorder=1)
        line.set_path_effects(edged(LINE + THIN))
    draw_marks(axes, x, np.zeros(len(x)), found)
    axes.plot([], [], "s", color=of_confidence(1.0), markeredgecolor=SHADOW, label="row at mid-height")


def _draw_scale(axes: Axes, highest: float) -> None:
    ticks = [tick for tick in MaxNLocator(MOST_TICKS).tick_values(0, highest) if 0 < tick <= highest]
    across = axes.get_yaxis_transform()
    for tick in ticks:
        axes.axhline(tick, color=GRID, linewidth=THIN, zorder=0)
        axes.text(INSET, tick, f"{tick:g}", transform=across, color=INK, fontsize=TICK_SIZE, va="bottom")
    axes.axhline(0, color=INK, linewidth=THIN)


def _clear(axes: Axes) -> None:
    """Nothing but paper: the picture above is the frame."""
    axes.set_facecolor(PAPER)
    axes.tick_params(length=0, labelbottom=False, labelleft=False)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _write_title(axes: Axes, title: str) -> None:
    axes.text(INSET, UPPER, title, transform=axes.transAxes, fontsize=FONT_SIZE, color=INK, va="top")
