"""The size of an error over distance, a band for the seeds, and beside it what that sums up to."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from scipy.ndimage import uniform_filter1d

from fieldnav.evaluation.campaign_drawing import (
    GOAL,
    INK,
    KNOWN,
    SMALL,
    WAY_COLOURS,
    dress,
    head,
)
from fieldnav.evaluation.navigation_cases import Spread
from fieldnav.evaluation.navigation_configurations import Configuration
from fieldnav.evaluation.navigation_figures import spread
from fieldnav.evaluation.navigation_lane import CELL_M, Lane
from fieldnav.messages import Floats

SMOOTHED_M = 1.0
"""Errors over distance are shown as means over so much of the lane."""
HEADROOM = 1.05
KNOWN_DASHES = (0, (5, 3))
SHORT = {Configuration.PAPER: "paper's", Configuration.PAPER_FINDER: "its finder"}
BAR_WIDTH = 0.7

Signed = Callable[[Lane], Floats]
ByWay = Mapping[Configuration, Sequence[Lane]]


@dataclass(frozen=True, slots=True)
class Graph:
    """An error to be drawn: its title, its signed value in each cell, its goal, what the paper reports."""

    title: str
    of: Signed
    goal: Spread
    known: Spread | None


def draw_error(pair: Sequence[Axes], graph: Graph, by_way: ByWay) -> None:
    """Draw the error over distance into the first of two graphs and its sums into the second."""
    axes, sums = pair
    for way, lanes in by_way.items():
        mean, std = over_seeds([graph.of(lane) for lane in lanes])
        along_m, colour = (np.arange(len(mean)) + 1 / 2) * CELL_M, WAY_COLOURS[way]
        low, high = np.maximum(0, mean - std), mean + std
        axes.fill_between(along_m, low, high, color=colour, alpha=0.25, linewidth=0)
        axes.plot(along_m, mean, color=colour, linewidth=1.6)
    for each in pair:
        each.axhline(graph.goal.mean, color=GOAL, linewidth=1.4)
        if graph.known is not None:
            each.axhline(graph.known.mean, color=KNOWN, linewidth=1.4, linestyle=KNOWN_DASHES)
        dress(each)
    _draw_sums(sums, graph, by_way)
    axes.set_ylim(0, axes.get_ylim()[1] * HEADROOM)
    head(axes, graph.title)
    head(sums, "Over all")


def _draw_sums(axes: Axes, graph: Graph, by_way: ByWay) -> None:
    """A bar for each way, the goal and the paper."""
    bars = [
        (
            SHORT.get(way, way.value),
            spread(np.concatenate([graph.of(lane) for lane in lanes])),
            WAY_COLOURS[way],
        )
        for way, lanes in by_way.items()
    ]
    bars.append(("goal", graph.goal, GOAL))
    if graph.known is not None:
        bars.append(("reported", graph.known, KNOWN))
    for place, (_, of, colour) in enumerate(bars):
        bar(axes, place, BAR_WIDTH, of, colour)
    axes.set_xticks(range(len(bars)), [name for name, _, _ in bars], fontsize=SMALL)


def bar(axes: Axes, at: float, width: float, of: Spread, colour: str) -> None:
    """A mean as a bar, its deviation as a whisker, and the mean in figures."""
    axes.bar(at, of.mean, width, color=colour, alpha=0.8)
    whisker = [[min(of.std, of.mean)], [of.std]]
    axes.errorbar(at, of.mean, yerr=whisker, color=INK, capsize=3, linewidth=1.0)
    top = (at, of.mean + of.std)
    axes.annotate(f"{of.mean:.1f}", top, (0, 3), textcoords="offset points", ha="center", fontsize=SMALL)


def over_seeds(signed: Sequence[Floats]) -> tuple[Floats, Floats]:
    """Mean and deviation over the seeds of an error's size, shape (cells,); NaN where none has it."""
    cells = min(len(each) for each in signed)
    width = max(1, round(SMOOTHED_M / CELL_M))
    sizes = np.stack([_smoothed(np.abs(each[:cells]), width) for each in signed])
    known = np.ma.masked_invalid(sizes)
    return known.mean(axis=0).filled(np.nan), known.std(axis=0).filled(np.nan)


def _smoothed(sizes: Floats, width: int) -> Floats:
    """Running means of what is known; NaN stays where it was."""
    known = np.isfinite(sizes)
    share = uniform_filter1d(known.astype(float), width, mode="nearest")
    mean = uniform_filter1d(np.where(known, sizes, 0.0), width, mode="nearest")
    smoothed: Floats = np.divide(mean, share, out=np.full_like(sizes, np.nan), where=known)
    return smoothed
