"""map.png: a run seen from above; the path coloured by what the robot was doing."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import ceil
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fieldnav.journal.files import whole_file
from fieldnav.journal.phases import INK, OTHER, PHASE_COLOURS, phase_of
from fieldnav.messages import Floats
from fieldnav.settings.one_line import one_line

SOIL, ROW, LANE = "#f6f2ea", "#a9cf9b", "#7fae72"
LONGEST_SHAPE = 9
"""Width over height of the ground past which a map in true proportion is a thread; it is stretched then."""

WIDTH_INCH, LEAST_HEIGHT_INCH, MOST_HEIGHT_INCH, DOTS_PER_INCH = 14.0, 3.4, 12.0, 130
FRAME_INCH = 1.6
"""Height of title, axis and legend together."""

MARGIN_M = 1.0


@dataclass(frozen=True, slots=True)
class RunMap:
    """What a map shows, in metres on the ground; every line an array of shape (n, 2).

    `path_m` has one state's name a point. `row_ends_m` and `crossings_m` have shape (n, 2): where the robot
    judged a row to end, and where it counted a row while moving sideways.
    """

    path_m: Floats
    states: Sequence[str]
    lanes_m: Sequence[Floats] = ()
    rows_m: Sequence[Floats] = ()
    row_ends_m: Floats = field(default_factory=lambda: np.empty((0, 2)))
    crossings_m: Floats = field(default_factory=lambda: np.empty((0, 2)))
    title: str = ""
    figures: str = ""


def draw_map(path: Path, run: RunMap) -> None:
    """Draw a run into a PNG file. Raises OutputError."""
    low, high = _extent(run)
    stretch = max(1, ceil((high[0] - low[0]) / (high[1] - low[1]) / LONGEST_SHAPE))
    figure, axes = _paper(low, high, stretch)
    for lines, colour, width in ((run.rows_m, ROW, 1.6), (run.lanes_m, LANE, 0.6)):
        style = (0, (6, 5)) if colour == LANE else "solid"
        axes.add_collection(LineCollection(list(lines), colors=colour, linewidths=width, linestyles=[style]))
    shown = _draw_path(axes, run)
    _mark(axes, run)
    _legend(figure, shown, run)
    axes.set_title(
        one_line(run.title),
        parse_math=False,
        loc="left",
        fontsize=13,
        fontweight="bold",
        color=INK,
        pad=24 if run.figures else 8,
    )
    axes.text(0, 1.0, run.figures, transform=axes.transAxes, fontsize=9.5, color=INK, va="bottom")
    with whole_file(path) as beside:
        figure.savefig(beside, dpi=DOTS_PER_INCH)


def _extent(run: RunMap) -> tuple[Floats, Floats]:
    points = np.concatenate([run.path_m, *run.lanes_m, *run.rows_m, run.row_ends_m, run.crossings_m])
    points = points if len(points) else np.zeros((1, 2))
    return points.min(axis=0) - MARGIN_M, points.max(axis=0) + MARGIN_M


def _paper(low: Floats, high: Floats, stretch: int) -> tuple[Figure, Axes]:
    width, height = (high - low) * (1, stretch)
    height_inch = min(max(WIDTH_INCH * height / width + FRAME_INCH, LEAST_HEIGHT_INCH), MOST_HEIGHT_INCH)
    figure = Figure(figsize=(WIDTH_INCH, height_inch), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(facecolor=SOIL)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), ylabel="across, m")
    axes.set_xlabel(
        f"along the lanes, m{'' if stretch == 1 else f'; across is drawn {stretch} times as large'}"
    )
    axes.set_aspect(stretch)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=9)
    return figure, axes


def _draw_path(axes: Axes, run: RunMap) -> list[str]:
    """Draw the path; returns the phases that occur in it."""
    if len(run.path_m) == 0:
        return []
    phases = [phase_of(state) for state in run.states]
    segments = np.stack([run.path_m[:-1], run.path_m[1:]], axis=1)
    colours = [PHASE_COLOURS[phase] for phase in phases[:-1]]
    axes.add_collection(
        LineCollection(list(segments), colors=colours, linewidths=2.6, capstyle="round", zorder=3)
    )
    axes.plot(*run.path_m[0], marker="o", color="white", markeredgecolor=INK, markersize=9, zorder=5)
    axes.plot(*run.path_m[-1], marker="s", color=INK, markeredgecolor="white", markersize=9, zorder=5)
    return [phase for phase in PHASE_COLOURS if phase in phases and phase != OTHER]


def _mark(axes: Axes, run: RunMap) -> None:
    axes.plot(*run.row_ends_m.T, "D", color="#ffd23f", markeredgecolor=INK, markersize=7, zorder=4)
    axes.plot(*run.crossings_m.T, "x", color=INK, markeredgewidth=2, markersize=8, zorder=4)


def _legend(figure: Figure, phases: Sequence[str], run: RunMap) -> None:
    handles = [
        Line2D([], [], color=PHASE_COLOURS[phase], linewidth=3, label=phase.lower()) for phase in phases
    ]
    marks = [
        ("o", "white", "start", len(run.path_m)),
        ("s", INK, "end", len(run.path_m)),
        ("D", "#ffd23f", "row end", len(run.row_ends_m)),
        ("x", INK, "row counted", len(run.crossings_m)),
    ]
    handles += [
        Line2D([], [], linestyle="", marker=marker, color=colour, markeredgecolor=INK, label=label)
        for marker, colour, label, count in marks
        if count
    ]
    if run.rows_m:
        handles.append(Line2D([], [], color=ROW, linewidth=2, label="crop row"))
    figure.legend(
        handles=handles, loc="outside lower center", ncols=len(handles), frameon=False, fontsize=9.5
    )
