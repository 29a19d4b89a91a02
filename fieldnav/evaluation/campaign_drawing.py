"""How the pictures of campaigns look, and how they get into files."""

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fieldnav.evaluation.navigation_configurations import Configuration
from fieldnav.journal.files import whole_file

INK, PAPER, GRID, FAINT = "#2b2b2b", "#fbfaf7", "#dddad2", "#8c8c8c"
GOAL, KNOWN, FAILED = "#2d8a3e", "#b5341f", "#d01c1c"
"""What ours must reach, what the paper reports, what went wrong."""
WAY_COLOURS = {
    Configuration.DEFAULT: "#1f6fb4",
    Configuration.PAPER_FINDER: "#8a5fc4",
    Configuration.PAPER: "#e69200",
}
SMALL, NORMAL, LARGE = 9.0, 10.0, 13.0
"""Sizes of type, in points."""
DOTS_PER_INCH = 130


def paper(width_inch: float, height_inch: float, title: str, said: str) -> Figure:
    """An empty picture with a title and a line below that says what it shows."""
    figure = Figure(figsize=(width_inch, height_inch), facecolor=PAPER, layout="constrained")
    figure.suptitle(title, x=0.01, ha="left", fontsize=LARGE, fontweight="bold", color=INK)
    figure.supxlabel(said, x=0.01, ha="left", fontsize=SMALL, color=INK)
    return figure


def dress(axes: Axes, grid: bool = True) -> None:
    """Take off what tells nothing."""
    axes.set_facecolor(PAPER)
    if grid:
        axes.grid(color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)
    axes.tick_params(colors=INK, length=0, labelsize=SMALL)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(FAINT)


def head(axes: Axes, title: str) -> None:
    """A graph's own title."""
    axes.set_title(title, loc="left", fontsize=NORMAL, fontweight="bold", color=INK)


def save(figure: Figure, path: Path) -> None:
    """Write the picture into a PNG file. Raises OutputError."""
    with whole_file(path) as beside:
        figure.savefig(beside, dpi=DOTS_PER_INCH)
