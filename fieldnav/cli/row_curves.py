"""What was found, drawn over the picture: rows as curves, the lane, plants, and the horizon."""

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fieldnav.cli.detection import Detection
from fieldnav.cli.detection_colours import LANE, LIGHT, PLANT, SHADOW, edged, of_confidence
from fieldnav.cli.row_labels import label_rows
from fieldnav.messages import Floats

NEAR_HORIZON = np.array([0.04, 0.12])
"""Of the picture's height: how far below it the rows' directions are taken."""
ROW_WIDTH, ROW_EDGE = 2.2, 4.4
LANE_WIDTH, LANE_STRENGTH = 9.0, 0.5
THIN, DASHES = 1.4, (0, (4, 3))
MARK_SIZE, VANISHING_SIZE = 8.0, 11.0
PLANT_SIZE, SMALLEST_PLANT_SIZE, MANY_PLANTS = 5.0, 2.4, 60
"""Points; the more plants, beyond so many, the smaller their dots."""
CAPTION_SIZE = 9.0
BELOW_HORIZON = 0.03
"""Of the picture's height: rows are drawn up to here; nearer to the horizon they are one."""


def draw_found(axes: Axes, found: Detection) -> None:
    """Draw on axes whose units are the picture's pixels."""
    _draw_lane(axes, found)
    _draw_plants(axes, found)
    curves = [below_horizon(path, found) for path in found.view.paths_px]
    confidences = [row.confidence for row in found.view.lines]
    for curve, confidence in zip(curves, confidences, strict=True):
        axes.plot(
            *curve.T,
            color=of_confidence(confidence),
            linewidth=ROW_WIDTH,
            path_effects=edged(ROW_EDGE),
            solid_capstyle="round",
            zorder=4,
        )
    draw_marks(axes, crossings_px(found), np.full(len(curves), (found.height_px - 1) / 2), found)
    label_rows(axes, curves, confidences, found.width_px, found.height_px)
    _draw_horizon(axes, found)


def crossings_px(found: Detection) -> Floats:
    """Where each row passes the picture's mid-height, shape (rows,)."""
    middle = (found.height_px - 1) / 2
    return np.array([np.interp(middle, path[:, 1], path[:, 0]) for path in found.view.paths_px])


def draw_marks(axes: Axes, x: Floats, y: Floats, found: Detection) -> None:
    """Squares in the rows' colours: the same ones in the picture and in the graph beneath."""
    colours = [of_confidence(row.confidence) for row in found.view.lines]
    axes.scatter(x, y, s=MARK_SIZE**2, c=colours, marker="s", edgecolors=SHADOW, linewidths=THIN, zorder=5)


def below_horizon(path_px: Floats, found: Detection) -> Floats:
    """The part of a row's curve that lies on the ground, shape (points, 2)."""
    horizon = found.horizon_px
    if horizon is None:
        return path_px
    least = max(0.0, horizon + BELOW_HORIZON * found.height_px, float(path_px[0, 1]))
    kept: NDArray[np.bool_] = path_px[:, 1] > least
    first = [np.interp(least, path_px[:, 1], path_px[:, 0]), least]
    return np.concatenate([[first], path_px[kept]])


def _draw_lane(axes: Axes, found: Detection) -> None:
    """The lane's rows as broad pale bands beneath all else; dashed where a row was filled in, not seen."""
    if found.view.lane is None:
        return
    last = found.height_px - 1
    upper = max(0.0, found.horizon_px or 0.0)
    for row in found.view.lane.rows:
        style = "solid" if row.confidence > 0 else DASHES
        (band,) = axes.plot(
            [row.at(upper, last), row.x_bottom_px], [upper, last], color=LANE, linestyle=style, zorder=2
        )
        band.set(linewidth=LANE_WIDTH, alpha=LANE_STRENGTH)


def _draw_plants(axes: Axes, found: Detection) -> None:
    place = found.view.centres.position_px
    size = max(SMALLEST_PLANT_SIZE, PLANT_SIZE * min(1.0, (MANY_PLANTS / max(len(place), 1)) ** 0.5))
    (dots,) = axes.plot(*place.T, linestyle="none", marker="o", color=PLANT, zorder=3)
    dots.set(
        markersize=size, markeredgecolor=SHADOW, markeredgewidth=(size - SMALLEST_PLANT_SIZE) / PLANT_SIZE
    )


def _draw_horizon(axes: Axes, found: Detection) -> None:
    """The horizon and where the rows meet on it, as far as the picture shows them."""
    y = found.horizon_px
    if y is None or not 0 <= y < found.height_px:
        return
    axes.axhline(y, color=LIGHT, linewidth=THIN, linestyle=DASHES, path_effects=edged(2 * THIN), zorder=4)
    if len(found.view.paths_px):
        (ring,) = axes.plot(_vanishing_x(found, y), y, marker="o", markerfacecolor="none", zorder=5)
        ring.set(markersize=VANISHING_SIZE, markeredgecolor=LIGHT, path_effects=edged(2 * THIN))
    axes.annotate(
        "horizon",
        (1, y),
        xycoords=axes.get_yaxis_transform(),
        xytext=(-CAPTION_SIZE, -CAPTION_SIZE / 2),
        textcoords="offset points",
        ha="right",
        va="top",
        color=LIGHT,
        fontsize=CAPTION_SIZE,
        path_effects=edged(2 * THIN),
    )


def _vanishing_x(found: Detection, horizon_px: float) -> float:
    """Where the rows' upper ends, carried on straight, meet the horizon."""
    begins = max(horizon_px, *(float(path[0, 1]) for path in found.view.paths_px))
    y = begins + NEAR_HORIZON * found.height_px
    x = np.stack([np.interp(y, path[:, 1], path[:, 0]) for path in found.view.paths_px])
    slope = (x[:, 1] - x[:, 0]) / (y[1] - y[0])
    return float(np.median(x[:, 0] + slope * (horizon_px - y[0])))
