"""A field of `bench navigation` as a picture: path against centre line, errors over distance, histograms."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fieldnav.evaluation.campaign_drawing import (
    GOAL,
    INK,
    KNOWN,
    NORMAL,
    WAY_COLOURS,
    dress,
    head,
    paper,
)
from fieldnav.evaluation.navigation_bands import KNOWN_DASHES, SMOOTHED_M, ByWay, Graph, draw_error
from fieldnav.evaluation.navigation_cases import Case
from fieldnav.evaluation.navigation_configurations import Configuration
from fieldnav.evaluation.navigation_figures import CENTIMETRES
from fieldnav.evaluation.navigation_lane import CELL_M, Lane
from fieldnav.messages import Floats

SIZE_INCH = (14.0, 10.0)
WIDTHS = (4.2, 1.0)
SHOWN = (Configuration.PAPER, Configuration.DEFAULT)
"""Drawn one over the other; what lies between would hide both."""
BINS = 41
HEADROOM, LEAST_SHOWN_CM = 1.15, 4.0
"""Of the path's graph: over the largest offset, and a reach that shows a small one to be small."""
CENTRE_DASHES = (0, (6, 4))


def lane_picture(case: Case, lanes: Sequence[Lane]) -> Figure:
    """Three graphs over the distance along the lane and beside each what it sums up to."""
    by_way = {way: [lane for lane in lanes if lane.drive.configuration is way] for way in SHOWN}
    by_way = {way: its for way, its in by_way.items() if its}
    figure = paper(*SIZE_INCH, f"{case.name}: how far off the lane's centre line", _said(lanes))
    axes = figure.subplots(3, 2, width_ratios=WIDTHS, sharey="row")
    _draw_path(axes[0, 0], by_way)
    _draw_histogram(axes[0, 1], by_way)
    for pair, graph in zip(axes[1:], _graphs(case), strict=True):
        draw_error(pair, graph, by_way)
    axes[-1, 0].set_xlabel("along the lane, m", color=INK, fontsize=NORMAL)
    _add_legend(figure, case, by_way)
    return figure


def _said(lanes: Sequence[Lane]) -> str:
    seeds = len({lane.drive.run.field.seed for lane in lanes})
    return (
        f"Simulated, every disturbance on; {seeds} seed{'s' if seeds > 1 else ''}. Bands: mean and standard "
        f"deviation over seeds, smoothed over {SMOOTHED_M:g} m. "
        "Bars: mean and standard deviation over the whole length."
    )


def _graphs(case: Case) -> tuple[Graph, Graph]:
    goal, known = case.goal, case.paper
    distance, angle = (known.distance_cm, known.angle_deg) if known else (None, None)
    return (
        Graph("Distance from the centre line, cm", _offset_cm, goal.distance_cm, distance),
        Graph("Angle to the centre line, deg", _heading_deg, goal.angle_deg, angle),
    )


def _draw_path(axes: Axes, by_way: ByWay) -> None:
    axes.axhline(0, color=INK, linewidth=1.2, linestyle=CENTRE_DASHES)
    for way, lanes in by_way.items():
        for lane in lanes:
            along_m = (np.arange(len(lane.offset_m)) + 1 / 2) * CELL_M
            axes.plot(along_m, _offset_cm(lane), color=WAY_COLOURS[way], linewidth=1.1, alpha=0.75)
    largest_cm = [np.nanmax(np.abs(_offset_cm(lane)), initial=0.0) for its in by_way.values() for lane in its]
    limit = max(LEAST_SHOWN_CM, HEADROOM * max(largest_cm))
    axes.set_ylim(-limit, limit)
    axes.set_ylabel("right  <  offset, cm  >  left", color=INK, fontsize=NORMAL)
    head(axes, "Path of each seed beside the lane's centre line")
    dress(axes)


def _draw_histogram(axes: Axes, by_way: ByWay) -> None:
    limit = axes.get_ylim()[1]
    edges = np.linspace(-limit, limit, BINS + 1)
    for way, lanes in by_way.items():
        offsets = np.concatenate([_offset_cm(lane) for lane in lanes])
        offsets = offsets[np.isfinite(offsets)]
        share = np.histogram(offsets, edges)[0] / max(1, len(offsets))
        axes.stairs(share, edges, orientation="horizontal", fill=True, color=WAY_COLOURS[way], alpha=0.3)
        axes.stairs(share, edges, orientation="horizontal", color=WAY_COLOURS[way], linewidth=1.6)
    axes.axhline(0, color=INK, linewidth=1.2, linestyle=CENTRE_DASHES)
    axes.set_xticks([])
    head(axes, "Share of the length")
    dress(axes)


def _add_legend(figure: Figure, case: Case, by_way: ByWay) -> None:
    handles = [Line2D([], [], color=WAY_COLOURS[way], linewidth=4, label=way.value) for way in by_way]
    handles.append(Line2D([], [], color=GOAL, linewidth=1.6, label="goal for the default"))
    if case.paper is not None:
        label = f"reported: {case.measured}"
        handles.append(Line2D([], [], color=KNOWN, linewidth=1.6, linestyle=KNOWN_DASHES, label=label))
    figure.legend(
        handles=handles, loc="outside upper right", ncols=len(handles), frameon=False, fontsize=NORMAL
    )


def _offset_cm(lane: Lane) -> Floats:
    return lane.offset_m * CENTIMETRES


def _heading_deg(lane: Lane) -> Floats:
    return np.degrees(lane.heading_rad)
