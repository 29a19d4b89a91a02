"""reliability.png: the share of rows that are right over the confidence they were given."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, PercentFormatter

from fieldnav.evaluation.reliability import BINS, Bin, JudgedRows, bins, calibration_error, counts_by_bin
from fieldnav.journal.files import whole_file

PICTURE = "reliability.png"
INK, PAPER, GRID, SHARE, IDEAL = "#2b2b2b", "#fbfaf7", "#dddad2", "#1f6fb4", "#8c8c8c"
SET_COLOURS = ("#2d8a3e", "#e69200", "#7b5ea7")
SIZE_INCH, DOTS_PER_INCH = (7.0, 7.6), 130
SHAPE = (3.2, 1.0)
"""Heights of the two graphs, one to the other."""

BAR = 0.9
"""Width of a bar, of its bin's."""

SHARE_HEADROOM, COUNT_HEADROOM = 1.08, 1.3
"""Heights of the axes over the highest that they show: whiskers and the legend lie there."""

CONFIDENCE_TICKS = np.linspace(0, 1, BINS + 1)


def draw_reliability(path: Path, judged: Mapping[str, JudgedRows]) -> None:
    """Draw the rows of every set, by its title, into a PNG file. Raises OutputError."""
    figure = Figure(figsize=SIZE_INCH, facecolor=PAPER, layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=SHAPE)
    every = JudgedRows.joined(judged.values())
    _draw_shares(upper, every)
    _draw_counts(lower, judged)
    title = "Is a row of confidence 0.8 right eight times in ten?"
    upper.set_title(title, loc="left", fontsize=13, fontweight="bold", color=INK, pad=24)
    said = (
        f"{len(every)} rows found in photographs; expected calibration error {calibration_error(every):.3f}"
    )
    upper.text(0, 1.02, said, transform=upper.transAxes, fontsize=9.5, color=INK, va="bottom")
    with whole_file(path) as beside:
        figure.savefig(beside, dpi=DOTS_PER_INCH)


def _draw_shares(axes: Axes, every: JudgedRows) -> None:
    found = bins(every)
    confidence, share = [each.confidence for each in found], [each.share for each in found]
    axes.plot(
        [0, 1], [0, 1], color=IDEAL, linewidth=1.2, linestyle=(0, (5, 4)), label="what confidence promises"
    )
    low = np.array([each.low for each in found])
    axes.bar(low + 0.5 / BINS, share, BAR / BINS, color=SHARE, alpha=0.16, linewidth=0)
    axes.errorbar(
        confidence,
        share,
        yerr=np.array([_whiskers(each) for each in found]).T,
        color=SHARE,
        marker="o",
        markersize=7,
        linewidth=1.6,
        capsize=3,
        label="rows that are right, with standard error",
    )
    axes.set_ylim(0, SHARE_HEADROOM)
    axes.yaxis.set_major_formatter(PercentFormatter(1.0))
    axes.set_ylabel("share of rows that are right", color=INK)
    axes.legend(
        loc="upper left", fontsize=10, facecolor=PAPER, edgecolor=PAPER, framealpha=1.0, labelcolor=INK
    )
    _dress(axes)


def _whiskers(of: Bin) -> tuple[float, float]:
    """The standard error downwards and upwards, within what a share can be."""
    return min(of.standard_error, of.share), min(of.standard_error, 1 - of.share)


def _draw_counts(axes: Axes, judged: Mapping[str, JudgedRows]) -> None:
    below, middles = np.zeros(BINS), CONFIDENCE_TICKS[:-1] + 0.5 / BINS
    for (title, rows), colour in zip(judged.items(), SET_COLOURS, strict=False):
        counts = counts_by_bin(rows)
        axes.bar(middles, counts, BAR / BINS, bottom=below, color=colour, label=title)
        below += counts
    axes.set_ylim(0, COUNT_HEADROOM * below.max())
    axes.set_xlim(0, 1)
    axes.set_xticks(CONFIDENCE_TICKS)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=4, integer=True))
    axes.set_xlabel("confidence given", color=INK)
    axes.set_ylabel("rows", color=INK)
    axes.legend(
        loc="upper left", fontsize=10, facecolor=PAPER, edgecolor=PAPER, framealpha=1.0, labelcolor=INK
    )
    _dress(axes)


def _dress(axes: Axes) -> None:
    axes.set_facecolor(PAPER)
    axes.grid(axis="y", color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)
    axes.tick_params(colors=INK, length=0)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(IDEAL)
