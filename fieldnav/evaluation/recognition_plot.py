"""precision_recall.png: precision over recall of telling a new row from the same, one graph a crop."""

from collections.abc import Mapping
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

from fieldnav.evaluation.recognition_scores import Curve, JudgedPairs, Scores, curve, scores
from fieldnav.journal.files import whole_file
from fieldnav.settings.lane_change import Recognition

PICTURE = "precision_recall.png"
INK, PAPER, GRID, OURS, THEIRS = "#2b2b2b", "#fbfaf7", "#dddad2", "#1f6fb4", "#c2571a"
COLUMNS = 4
GRAPH_INCH, HEAD_INCH, DOTS_PER_INCH = 3.2, 1.1, 110
LEAST = 0.75
"""Of either axis; a pair of two rows and one of the same are equally frequent, so that 0.5 is a guess."""

MARGIN = 0.02
"""Beyond 1, so that curves along the edge are seen."""

ISO_F1 = 0.95


def draw_recognition(
    folder: Path, judged: Mapping[str, JudgedPairs], settings: Mapping[str, Recognition]
) -> None:
    """Draw the curves of every crop, by its name, into a folder. Raises OutputError."""
    lines = -(-len(judged) // COLUMNS)
    size = (COLUMNS * GRAPH_INCH, lines * GRAPH_INCH + HEAD_INCH)
    figure = Figure(figsize=size, facecolor=PAPER, layout="constrained")
    graphs = figure.subplots(lines, COLUMNS, sharex=True, sharey=True, squeeze=False)
    for axes in graphs.flat[len(judged) :]:
        axes.remove()
    for axes, (name, pairs) in zip(graphs.flat, judged.items(), strict=False):
        _draw_crop(axes, name, pairs, settings[name])
    for axes in graphs[-1]:
        axes.set_xlabel("recall of new rows", color=INK)
    for axes in graphs[:, 0]:
        axes.set_ylabel("precision", color=INK)
    figure.suptitle("Is this a new crop row, or the same one again?", color=INK, fontweight="bold")
    handles, labels = graphs.flat[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False, labelcolor=INK)
    with whole_file(folder / PICTURE) as beside:
        figure.savefig(beside, dpi=DOTS_PER_INCH)


def _draw_crop(axes: Axes, name: str, pairs: JudgedPairs, settings: Recognition) -> None:
    share, far = settings.new_row_share, settings.new_row_distance
    ours, theirs = curve(-pairs.share, pairs.is_new), curve(pairs.distance, pairs.is_new)
    at = scores(pairs.share < share, pairs.is_new)
    paper = scores(pairs.distance > far, pairs.is_new)
    _draw_goal(axes)
    _draw_curve(axes, theirs, paper, THEIRS, (0, (4, 3)), "the paper's mean distance, at its threshold")
    _draw_curve(axes, ours, at, OURS, "solid", "features that moved together, at the threshold shipped")
    title = f"{name}\nF1 {at.f1:.1%} at {share:g}; the paper's {paper.f1:.1%} at {far:g}"
    axes.set_title(title, loc="left", fontsize=9, color=INK)
    axes.set_facecolor(PAPER)
    axes.grid(color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)
    axes.tick_params(colors=INK, length=0)
    axes.set_xlim(LEAST, 1 + MARGIN)
    axes.set_ylim(LEAST, 1 + MARGIN)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    for spine in axes.spines.values():
        spine.set_visible(False)


def _draw_curve(
    axes: Axes, of: Curve, at: Scores, colour: str, line: str | tuple[int, tuple[int, int]], label: str
) -> None:
    axes.plot(of.recall, of.precision, color=colour, linestyle=line, linewidth=1.7)
    axes.plot(at.recall, at.precision, color=colour, marker="o", linestyle=line, linewidth=1.7, label=label)


def _draw_goal(axes: Axes) -> None:
    """The line on which F1 is 95 %."""
    recall = [LEAST + (1 - LEAST) * step / 200 for step in range(201)]
    points = [(r, ISO_F1 * r / (2 * r - ISO_F1)) for r in recall if 2 * r > ISO_F1]
    inside = [(r, p) for r, p in points if p <= 1]
    axes.plot(*zip(*inside, strict=True), color=INK, linewidth=0.8, linestyle=":", label="F1 of 95 %")
