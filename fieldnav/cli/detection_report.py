"""What was found in a picture, in words: an object for a program, a table for a person."""

from math import degrees
from typing import Any

import numpy as np

from drivers.encoded_picture import further_pictures
from fieldnav.cli.console import out, print_line, print_warning, table
from fieldnav.cli.detection import Detection
from fieldnav.cli.pictures import unlit
from fieldnav.messages import Floats

PIXEL_DIGITS, ANGLE_DIGITS, SCORE_DIGITS, MILLISECOND_DIGITS = 1, 2, 3, 1
TILT_DIGITS, HEIGHT_DIGITS = 1, 2
"""Decimals that are printed; more would be noise."""
NO_FIELD = 0.1
"""Probability of a field below which there is none in view: of photographs of fields 2 in 100 get less."""
CURVE_POINTS = 9
"""Of a row, from the upper end to the lower: a bend between two of them is less than a pixel."""


def document(found: Detection) -> dict[str, Any]:
    """The detection as `--json` prints it."""
    return {
        "image": found.path,
        "width": found.width_px,
        "height": found.height_px,
        "rows": [
            {
                "x_top": round(row.x_top_px, PIXEL_DIGITS),
                "x_bottom": round(row.x_bottom_px, PIXEL_DIGITS),
                "angle_deg": round(found.angle_deg(row), ANGLE_DIGITS),
                "score": round(row.confidence, SCORE_DIGITS),
                "points": _points(path, found.height_px),
            }
            for row, path in zip(found.view.lines, found.view.paths_px, strict=True)
        ],
        "camera": _camera(found),
        "field": None if found.view.field is None else round(found.view.field, SCORE_DIGITS),
        "milliseconds": round(found.milliseconds, MILLISECOND_DIGITS),
    }


def print_table(found: Detection) -> None:
    """The detection for a person, on standard output."""
    lines = found.view.lines
    columns = ("row", "x at top", "x at bottom", "angle", "score")
    rows = [
        (
            str(number),
            f"{row.x_top_px:.{PIXEL_DIGITS}f} px",
            f"{row.x_bottom_px:.{PIXEL_DIGITS}f} px",
            f"{found.angle_deg(row):+.{ANGLE_DIGITS}f} deg",
            f"{row.confidence:.2f}",
        )
        for number, row in enumerate(lines, start=1)
    ]
    size = f"{found.width_px}x{found.height_px}"
    print_line(f"{found.path}: {counted(found)}, {size}, {found.milliseconds:.{MILLISECOND_DIGITS}f} ms")
    print_line(camera_line(found))
    if found.view.field is not None:
        print_line(field_line(found.view.field))
    if found.known.robot and found.known.crop:
        print_line(f"looked for rows of {found.known.crop.name}, {found.known.crop.rows.spacing_m:g} m apart")
    if rows:
        out().print(table("", columns, rows, right=columns))
    print()


def warn(found: Detection) -> None:
    """Say on standard error when a picture cannot show what is looked for."""
    if not np.ptp(found.image, axis=-1).any():
        print_warning(f"{found.path}: has no colour, by which plants are told from soil")
    if further := further_pictures(found.path):
        print_warning(f"{found.path}: holds {further + 1} pictures, of which the first alone is looked at")
    if unlit(found.image):
        print_warning(f"{found.path}: {unlit(found.image)}")


def counted(found: Detection) -> str:
    """How many rows and plants there are; plants are told apart only where the ground's scale is known."""
    lines, plants = len(found.view.lines), len(found.view.centres)
    rows = "no row" if not lines else f"{lines} row{'s' if lines > 1 else ''}"
    return rows if found.camera is None else f"{rows}, {plants} plant{'' if plants == 1 else 's'}"


def field_line(field: float) -> str:
    """Whether the picture shows a field of rows at all."""
    if field < NO_FIELD:
        return f"no field in view: that it shows one is {field:.0%} likely"
    return f"a field of rows in view: {field:.0%} likely"


def camera_line(found: Detection) -> str:
    """Where the camera is said to be, and who says so."""
    robot, crop, camera = found.known.robot, found.known.crop, found.camera
    if camera is None:
        return "camera unknown: there are no rows in the picture to estimate it from"
    tilt = f"tilt {degrees(camera.tilt_rad):.{TILT_DIGITS}f} deg"
    height = f"height {camera.height_m:.{HEIGHT_DIGITS}f} m"
    row = found.horizon_px
    horizon = "no horizon" if row is None else f"horizon at y = {row:.0f} px"
    if robot is not None:
        return f"camera of {robot.name}: {tilt}, {height}, {horizon}"
    height = (
        f"{height} by the row spacing of {crop.name}, {crop.rows.spacing_m:g} m"
        if crop
        else "height unknown without a crop"
    )
    return f"camera estimated from the picture, by how its rows run together: {tilt}, {height}, {horizon}"


def _points(path_px: Floats, height_px: int) -> list[list[float]]:
    """A row's curve at image rows evenly spaced from the upper edge of the ground to the lower edge."""
    x, y = path_px.T
    at = np.linspace(y[0], height_px - 1, CURVE_POINTS)
    points = np.stack([np.interp(at, y, x), at], axis=-1)
    return [[float(value) for value in point] for point in points.round(PIXEL_DIGITS)]


def _camera(found: Detection) -> dict[str, Any]:
    tilt_deg = None if found.camera is None else degrees(found.camera.tilt_rad)
    return {
        "estimated": found.estimated,
        "tilt_deg": _rounded(tilt_deg, TILT_DIGITS),
        "height_m": _rounded(found.height_m, HEIGHT_DIGITS),
        "horizon_px": _rounded(found.horizon_px, PIXEL_DIGITS),
    }


def _rounded(value: float | None, digits: int) -> float | None:
    return None if value is None else round(value, digits)
