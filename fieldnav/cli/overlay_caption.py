"""Two lines beneath an overlay's picture: what was known and found, and what the marks mean."""

from math import degrees

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from fieldnav.cli.detection import Detection
from fieldnav.cli.detection_colours import INK, LANE, PLANT, SHADOW, edged, of_confidence
from fieldnav.cli.detection_report import counted
from fieldnav.settings.one_line import one_line

FONT_SIZE, LINE_WIDTH, EDGE, BAND_WIDTH, DOT_SIZE = 9.5, 2.5, 4.5, 8.0, 5.0
"""Points."""
INSET, FIRST_LINE, SECOND_LINE = 0.006, 0.71, 0.27
"""Of the caption's width and height."""
EXPLAINED = (1.0, 0.75, 0.5)
"""Confidences whose colours are shown; rows are reported from about the last one on."""


def write_caption(axes: Axes, found: Detection) -> None:
    """Write on axes that take the picture's whole width and have room for two lines."""
    axes.set_axis_off()
    said = (counted(found), _crop(found), _camera(found), f"found in {found.milliseconds:.0f} ms")
    line = one_line("   |   ".join(said))
    place = axes.transAxes
    axes.text(
        INSET, FIRST_LINE, line, transform=place, va="center", color=INK, fontsize=FONT_SIZE, parse_math=False
    )
    key = _key(found)
    if key:
        axes.legend(
            handles=key,
            loc="center left",
            bbox_to_anchor=(INSET, SECOND_LINE),
            ncols=len(key),
            fontsize=FONT_SIZE,
            labelcolor=INK,
            frameon=False,
            borderpad=0,
            borderaxespad=0,
        )


def _crop(found: Detection) -> str:
    return "any crop" if found.known.crop is None else f"crop {found.known.crop.name}"


def _camera(found: Detection) -> str:
    camera, horizon = found.camera, found.horizon_px
    if camera is None:
        return "camera unknown: no rows tell of it"
    source = "camera estimated" if found.known.robot is None else f"camera of {found.known.robot.name}"
    height = "height unknown" if found.height_m is None else f"{found.height_m:.2f} m up"
    said = f"{source}: tilt {degrees(camera.tilt_rad):.1f}°, {height}"
    if horizon is None:
        return said
    return f"{said}, horizon {f'{-horizon:.0f} px above the picture' if horizon < 0 else 'in view'}"


def _key(found: Detection) -> list[Line2D]:
    """One entry for each kind of mark that the picture has."""
    rows = [
        Line2D([], [], color=of_confidence(sure), linewidth=LINE_WIDTH, path_effects=edged(EDGE), label=label)
        for sure, label in zip(EXPLAINED, ("row, confidence 1", *map(str, EXPLAINED[1:])), strict=True)
    ]
    plant = Line2D([], [], color=PLANT, marker="o", markersize=DOT_SIZE, linestyle="none", label="plant")
    plant.set_markeredgecolor(SHADOW)
    lane = Line2D([], [], color=LANE, linewidth=BAND_WIDTH, label="row of the robot's lane")
    lane.set_path_effects(edged(BAND_WIDTH + 1))
    view = found.view
    shown = ((rows, len(view.lines)), ([plant], len(view.centres)), ([lane], view.lane is not None))
    return [entry for entries, seen in shown if seen for entry in entries]
