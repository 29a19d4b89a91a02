"""All fields of `bench navigation` in one picture: mean and deviation beside the paper's and the goal."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from fieldnav.evaluation.campaign_drawing import (
    FAINT,
    GOAL,
    INK,
    KNOWN,
    NORMAL,
    WAY_COLOURS,
    dress,
    paper,
)
from fieldnav.evaluation.navigation_bands import bar
from fieldnav.evaluation.navigation_cases import Case, Errors, Spread
from fieldnav.evaluation.navigation_configurations import Configuration
from fieldnav.evaluation.navigation_figures import CENTIMETRES, spread
from fieldnav.evaluation.navigation_lane import Lane
from fieldnav.messages import Floats

WIDTH_INCH, HEIGHT_INCH = 14.0, 9.0
GROUP = 0.86
"""Share of a field's place that its bars take up."""
TITLE = "Mean errors in every field"

Driven = Mapping[Case, Sequence[Lane]]


def overview_picture(driven: Driven) -> Figure:
    """Two graphs, distance and angle, a group of bars a field."""
    said = (
        "Whiskers: standard deviation. Ours: simulated, every disturbance on, whole length, all seeds. "
        "The paper's: five crops in the field, three fields in another simulator."
    )
    figure = paper(WIDTH_INCH, HEIGHT_INCH, TITLE, said)
    upper, lower = figure.subplots(2, 1, sharex=True)
    _graph(upper, driven, lambda lane: lane.offset_m * CENTIMETRES, lambda errors: errors.distance_cm)
    _graph(lower, driven, lambda lane: np.degrees(lane.heading_rad), lambda errors: errors.angle_deg)
    upper.set_ylabel("distance from the centre line, cm", color=INK, fontsize=NORMAL)
    lower.set_ylabel("angle to it, deg", color=INK, fontsize=NORMAL)
    lower.set_xticks(range(len(driven)), [_in_lines(case.name) for case in driven])
    handles = [Patch(color=WAY_COLOURS[way], label=way.value) for way in _ways(driven)]
    handles += [Patch(color=KNOWN, alpha=0.75, label="the paper reports"), Patch(color=GOAL, label="goal")]
    figure.legend(
        handles=handles, loc="outside upper right", ncols=len(handles), frameon=False, fontsize=NORMAL
    )
    return figure


def _graph(
    axes: Axes, driven: Driven, of: Callable[[Lane], Floats], among: Callable[[Errors], Spread]
) -> None:
    ways = _ways(driven)
    width = GROUP / (len(ways) + 1)
    for group, (case, lanes) in enumerate(driven.items()):
        left = group - GROUP / 2 + width / 2
        for place, way in enumerate(ways):
            its = [of(lane) for lane in lanes if lane.drive.configuration is way]
            if its:
                bar(axes, left + place * width, width * GROUP, spread(np.concatenate(its)), WAY_COLOURS[way])
        if case.paper is not None:
            bar(axes, left + len(ways) * width, width * GROUP, among(case.paper), KNOWN)
        goal = among(case.goal)
        axes.hlines(goal.mean, group - GROUP / 2, group + GROUP / 2, color=GOAL, linewidth=2.4, zorder=4)
        if group:
            axes.axvline(group - 1 / 2, color=FAINT, linewidth=0.6)
    axes.set_ylim(bottom=0)
    axes.set_xlim(-1 / 2, len(driven) - 1 / 2)
    dress(axes)
    axes.grid(visible=False, axis="x")


def _ways(driven: Driven) -> list[Configuration]:
    found = {lane.drive.configuration for lanes in driven.values() for lane in lanes}
    return [way for way in Configuration if way in found]


def _in_lines(name: str) -> str:
    return name.replace(", ", ",\n").replace(" missing", "\nmissing")
