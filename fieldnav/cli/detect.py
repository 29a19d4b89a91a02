"""`fieldnav detect`: the crop rows of pictures, for a person, a program, or to look at."""

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fieldnav.cli.console import out, table
from fieldnav.settings.robot import LARGEST_SIDE_PX

if TYPE_CHECKING:
    from fieldnav.cli.pictures import Detection

PIXEL_DIGITS, ANGLE_DIGITS, SCORE_DIGITS, MILLISECOND_DIGITS = 1, 2, 3, 1
"""Decimals that are printed; more would be noise."""


def detect(
    images: Annotated[list[str], typer.Argument(help="Pictures, colour, of any size.", metavar="IMAGE")],
    crop: Annotated[str, typer.Option(help="Crop profile; name or path.")] = "sugar-beet",
    robot: Annotated[str, typer.Option(help="Robot whose front camera took them; name or path.")] = "bonnbot",
    overlay: Annotated[
        Path | None, typer.Option(help="Folder for pictures with what was found drawn in.", metavar="DIR")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object a line, for programs.")
    ] = False,
) -> None:
    """Find the crop rows in pictures, and say where they run.

    A row is the line x = x_top + (x_bottom - x_top) * y / (height - 1), in pixels.
    Its angle is from the image's vertical, positive clockwise.
    """
    # OpenCV reads this when it is loaded: a picture's head may claim any size, which is allocated at once.
    os.environ.setdefault("OPENCV_IO_MAX_IMAGE_PIXELS", str(LARGEST_SIDE_PX**2))
    # Here, because other commands need not wait for OpenCV.
    from fieldnav.cli import pictures  # noqa: PLC0415
    from fieldnav.cli.detection_overlay import draw_detection  # noqa: PLC0415
    from fieldnav.settings.loading import load_crop, load_robot  # noqa: PLC0415

    profile, camera = load_crop(crop), load_robot(robot).cameras.front
    for path in images:
        pictures.check(path, camera)
    overlays = pictures.overlay_paths(images, overlay) if overlay else {}
    for path in images:
        found = pictures.detect_rows(path, profile, camera)
        if as_json:
            print(json.dumps(_document(found), ensure_ascii=False), flush=True)
        else:
            _print_table(found)
        if path in overlays:
            pictures.write_picture(overlays[path], draw_detection(found))
            if not as_json:
                print(f"drawn in {overlays[path]}\n")


def _document(found: "Detection") -> dict[str, Any]:
    return {
        "image": found.path,
        "width": found.camera.width_px,
        "height": found.camera.height_px,
        "rows": [
            {
                "x_top": round(row.x_top_px, PIXEL_DIGITS),
                "x_bottom": round(row.x_bottom_px, PIXEL_DIGITS),
                "angle_deg": round(found.angle_deg(row), ANGLE_DIGITS),
                "score": round(row.confidence, SCORE_DIGITS),
            }
            for row in found.view.lines
        ],
        "milliseconds": round(found.milliseconds, MILLISECOND_DIGITS),
    }


def _print_table(found: "Detection") -> None:
    lines = found.view.lines
    count = "no row" if not lines else f"{len(lines)} row{'s' if len(lines) > 1 else ''}"
    size = f"{found.camera.width_px}x{found.camera.height_px}"
    title = f"{found.path}: {count}, {len(found.view.centres)} plants, {size}, {found.milliseconds:.1f} ms"
    columns = ("row", "x at top", "x at bottom", "angle", "score")
    rows = [
        (
            str(number),
            f"{row.x_top_px:.1f} px",
            f"{row.x_bottom_px:.1f} px",
            f"{found.angle_deg(row):+.2f} deg",
            f"{row.confidence:.2f}",
        )
        for number, row in enumerate(lines, start=1)
    ]
    print(title)
    if rows:
        out().print(table("", columns, rows, right=columns))
    print()
