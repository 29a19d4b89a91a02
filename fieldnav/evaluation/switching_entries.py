"""How new lanes were entered: offset against angle as following starts, a point a switch."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from fieldnav.evaluation.campaign_drawing import GOAL, INK, NORMAL, dress, paper
from fieldnav.evaluation.switching_figures import CENTIMETRES, ENTRY_GOAL_CM, ENTRY_GOAL_DEG
from fieldnav.evaluation.switching_runs import Switched
from fieldnav.evaluation.switching_truth import Switch

SIZE_INCH = (9.0, 7.6)
COLOURS = ("#1f6fb4", "#e69200", "#2d8a3e", "#d4357f", "#8a5fc4", "#2aa5a0", "#6b4f2a", "#2b2b2b")
MARKERS = "osD^vP*X"
POINT_SIZE = 34
SIDE = 1.25
"""Least side of the graph over that of the goal's box."""
BOTH = 2.0
SAID = (
    "Seen by a robot that looks forward; simulated, every disturbance on. Switches that failed are not shown."
)


def entry_picture(runs: Sequence[Switched]) -> Figure:
    """A colour and a marker a crop; the box holds the entries within the goals."""
    by_crop: dict[str, list[Switch]] = {}
    for run in runs:
        entered = [switch for switch in run.switches if switch.succeeded]
        by_crop.setdefault(run.wanted.run.crop.name, []).extend(entered)
    every = [switch for switches in by_crop.values() for switch in switches]
    figure = paper(*SIZE_INCH, _title(every), SAID)
    axes = figure.subplots()
    box = (-ENTRY_GOAL_CM, -ENTRY_GOAL_DEG), BOTH * ENTRY_GOAL_CM, BOTH * ENTRY_GOAL_DEG
    axes.add_patch(Rectangle(*box, facecolor=GOAL, alpha=0.12, edgecolor=GOAL, linewidth=1.5))
    for place, (crop, switches) in enumerate(sorted(by_crop.items())):
        offset_cm, angle_deg = _points(switches)
        colour, marker = COLOURS[place % len(COLOURS)], MARKERS[place % len(MARKERS)]
        axes.scatter(
            offset_cm, angle_deg, POINT_SIZE, color=colour, marker=marker, alpha=0.8, linewidths=0, label=crop
        )
    for limits, goal in ((axes.get_xlim, ENTRY_GOAL_CM), (axes.get_ylim, ENTRY_GOAL_DEG)):
        reach = max(SIDE * goal, *np.abs(limits()))
        (axes.set_xlim if goal == ENTRY_GOAL_CM else axes.set_ylim)(-reach, reach)
    axes.axhline(0, color=INK, linewidth=0.8)
    axes.axvline(0, color=INK, linewidth=0.8)
    axes.set_xlabel(
        "right  <  offset from the new lane's centre line, cm  >  left", color=INK, fontsize=NORMAL
    )
    axes.set_ylabel("clockwise  <  angle to it, deg  >  counter-clockwise", color=INK, fontsize=NORMAL)
    figure.legend(loc="outside right upper", frameon=False, fontsize=NORMAL)
    dress(axes)
    return figure


def _title(switches: Sequence[Switch]) -> str:
    offset_cm, angle_deg = _points(switches)
    within = int(((np.abs(offset_cm) <= ENTRY_GOAL_CM) & (np.abs(angle_deg) <= ENTRY_GOAL_DEG)).sum())
    box = f"{ENTRY_GOAL_CM:g} cm and {ENTRY_GOAL_DEG:g} degrees"
    return f"{len(switches)} new lanes entered, {within} within {box}"


def _points(switches: Sequence[Switch]) -> tuple[np.ndarray, np.ndarray]:
    offsets_m = np.array([switch.entry_offset_m for switch in switches], dtype=float)
    angles_rad = np.array([switch.entry_angle_rad for switch in switches], dtype=float)
    return offsets_m * CENTIMETRES, np.degrees(angles_rad)
