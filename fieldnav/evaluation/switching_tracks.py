"""Every switch of `bench switching` as a small track: seen from above, coloured by state."""

from collections.abc import Sequence
from math import ceil, sqrt

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from fieldnav.evaluation.campaign_drawing import FAILED, FAINT, INK, NORMAL, paper
from fieldnav.evaluation.switching_runs import Switched
from fieldnav.evaluation.switching_track import SwitchTrack
from fieldnav.evaluation.switching_truth import Switch
from states.names import Fault, Follow, Phase, Sidestep

SOIL, ROW = "#f6f2ea", "#8fbf7f"
COLOURS = {
    Phase.EXIT.value: "#e69200",
    Sidestep.ORIENTING.value: "#8c8c8c",
    Sidestep.SAMPLING.value: "#8a5fc4",
    Sidestep.CROSSING.value: "#d4357f",
    Sidestep.SETTLING.value: "#2aa5a0",
    **{leaf.value: "#1f6fb4" for leaf in Follow},
    **{leaf.value: FAILED for leaf in Fault},
}
OTHER = "#6b4f2a"
"""Of a state that is none of these."""
FOLLOWING = "following"
SHOWN_M = (-0.8, 2.0)
"""Outward, from the end of the lane that was left."""
BESIDE_M = 0.65
"""Shown on either side of the two lanes' middles."""
WIDE, CELL_INCH = 1.8, 1.05
"""Cells a row over rows of cells, and a cell's width."""
LEAST_WIDTH_INCH, LEAST_COLUMNS, FRAME_INCH = 14.0, 6, 1.4
TINY = 6.0


def tracks_picture(runs: Sequence[Switched]) -> Figure:
    """A cell a switch, crop by crop."""
    by_crop = sorted(runs, key=lambda run: (run.wanted.run.crop.name, run.wanted.run.field.seed))
    switches = [(run, switch) for run in by_crop for switch in run.switches]
    columns = max(LEAST_COLUMNS, ceil(sqrt(WIDE * len(switches))))
    rows = ceil(len(switches) / columns)
    width_inch = max(LEAST_WIDTH_INCH, columns * CELL_INCH)
    figure = paper(width_inch, rows * width_inch / columns + FRAME_INCH, _title(switches), SAID)
    cells = np.ravel(figure.subplots(rows, columns, squeeze=False))
    for axes in cells:
        axes.set_axis_off()
    for axes, (run, switch) in zip(cells, switches, strict=False):
        _cell(axes, run, switch)
    _legend(figure, [switch.track for _, switch in switches])
    return figure


SAID = (
    "Each from above: field below, headland above, the lane that is left at the left, the next at the right. "
    "Thick: the robot's centre; thin: its trailing camera. Red frame: failed. "
    "Above each: crop, right or left, -> after a lane driven forward, <- backward, seed.lane."
)


def _title(switches: Sequence[tuple[Switched, Switch]]) -> str:
    good = sum(switch.succeeded for _, switch in switches)
    return f"{len(switches)} lane switches, {good} succeeded"


def _cell(axes: Axes, run: Switched, switch: Switch) -> None:
    settings, shown = run.wanted.run, switch.track
    axes.set_axis_on()
    axes.set(xticks=[], yticks=[], facecolor=SOIL, aspect="equal", ylim=SHOWN_M)
    axes.set_xlim(-BESIDE_M, settings.field.lane_pitch_m + BESIDE_M)
    frame = (FAINT, 0.5) if switch.succeeded else (FAILED, 2.5)
    for spine in axes.spines.values():
        spine.set(color=frame[0], linewidth=frame[1])
    axes.set_title(_caption(run, switch), fontsize=TINY, color=INK, pad=2)
    axes.vlines(shown.rows_across_m, SHOWN_M[0], shown.rows_end_m, color=ROW, linewidth=2)
    _draw_track(axes, shown, settings.robot.cameras.get(switch.direction.trailing).distance_m)


def _caption(run: Switched, switch: Switch) -> str:
    settings = run.wanted.run
    side, way = settings.side.value[0], "->" if switch.direction.sign > 0 else "<-"
    return f"{settings.crop.name} {side}{way} {settings.field.seed}.{switch.lane}"


def _draw_track(axes: Axes, shown: SwitchTrack, camera_m: float) -> None:
    centre = np.stack([shown.across_m, shown.outward_m], axis=1)
    behind = np.stack([np.sin(shown.heading_rad), np.cos(shown.heading_rad)], axis=1)
    colours = [COLOURS.get(leaf, OTHER) for leaf in shown.leaves]
    for points, width in ((centre - camera_m * behind, 0.7), (centre, 1.8)):
        pieces = np.stack([points[:-1], points[1:]], axis=1)
        axes.add_collection(LineCollection(list(pieces), colors=colours, linewidths=width))


def _legend(figure: Figure, tracks: Sequence[SwitchTrack]) -> None:
    seen = {leaf for shown in tracks for leaf in shown.leaves}
    following = {leaf.value for leaf in Follow}
    labels = {leaf: colour for leaf, colour in COLOURS.items() if leaf in seen and leaf not in following}
    labels |= {leaf: OTHER for leaf in sorted(seen - set(COLOURS))}
    if seen & following:
        labels[FOLLOWING] = COLOURS[Follow.TRACKING.value]
    handles: list[Line2D | Patch] = [
        Line2D([], [], color=colour, linewidth=4, label=leaf.lower()) for leaf, colour in labels.items()
    ]
    handles.append(Line2D([], [], color=ROW, linewidth=4, label="crop row"))
    figure.legend(
        handles=handles, loc="outside upper right", ncols=len(handles), frameon=False, fontsize=NORMAL
    )
