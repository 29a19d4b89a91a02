"""`fieldnav detect`: the crop rows of pictures, for a person, a program, or to look at."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.camera_option import RobotOption
from fieldnav.cli.console import json_of, print_line
from fieldnav.cli.output_folder import output_path
from fieldnav.cli.picture_limit import limit_pictures

if TYPE_CHECKING:
    from fieldnav.cli.detection import Detection

USUAL_CROP = "sugar-beet"
"""Taken with a robot when no crop is named: its camera looks for rows of one spacing."""


def detect(
    images: Annotated[list[str], typer.Argument(help="Pictures, colour, of any size.", metavar="IMAGE")],
    crop: Annotated[
        str | None,
        typer.Option(
            help=f"Crop profile; name or path. Without one: rows of any spacing; with --robot: {USUAL_CROP}."
        ),
    ] = None,
    robot: RobotOption = None,
    overlay: Annotated[
        Path | None,
        typer.Option(
            parser=output_path, help="Folder for pictures with what was found drawn in.", metavar="DIR"
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object a line, for programs.")
    ] = False,
) -> None:
    """Find the crop rows in pictures, and say where they run.

    A row is the line x = x_top + (x_bottom - x_top) * y / (height - 1), in pixels.
    Its angle is from the image's vertical, positive clockwise.
    With --json it is also a curve: "points", from the upper edge to the lower,
    and of a robot whose camera has the horizon in view from where ground counts.

    Without --robot the camera is estimated: its tilt from how the rows run together,
    and with --crop also its height, from how far apart they are.
    """
    limit_pictures()  # a picture's head may claim any size, which is allocated at once
    # Here, because other commands need not wait for OpenCV.
    from fieldnav.cli import detection, detection_report, pictures  # noqa: PLC0415
    from fieldnav.settings.loading import load_crop, load_robot  # noqa: PLC0415

    named = USUAL_CROP if crop is None and robot is not None else crop
    known = detection.Known(
        None if named is None else load_crop(named), None if robot is None else load_robot(robot)
    )
    for path in dict.fromkeys(images):
        detection.check(path, known)
    overlays = pictures.overlay_paths(images, overlay) if overlay else {}
    detection.detect_rows(images[0], known)  # the first look of a process takes longer than all others
    for path in images:
        found = detection.detect_rows(path, known)
        if as_json:
            print(json_of(detection_report.document(found)), flush=True)
        else:
            detection_report.print_table(found)
        detection_report.warn(found)
        if path in overlays:
            _draw(found, overlays[path])
            if not as_json:
                print_line(f"drawn in {overlays[path]}")
                print()


def _draw(found: "Detection", path: Path) -> None:
    # Here, because without overlays nobody need wait for Matplotlib.
    from fieldnav.cli.detection_overlay import draw_detection  # noqa: PLC0415
    from fieldnav.cli.pictures import write_picture  # noqa: PLC0415

    write_picture(path, draw_detection(found))
