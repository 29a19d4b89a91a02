"""`fieldnav count`: the rows that pass sideways in a folder of frames or a video."""

from collections.abc import Sequence
from math import ceil
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.camera_option import RobotOption
from fieldnav.cli.console import json_of, out, print_line, print_warning, table
from fieldnav.cli.part_progress import watched
from fieldnav.cli.picture_limit import limit_pictures
from fieldnav.evaluation.benchmark import Progress
from fieldnav.messages import Side

if TYPE_CHECKING:
    from fieldnav.cli.frames import Frames
    from fieldnav.perception.counting.row_count import RowCount
    from fieldnav.perception.counting.row_counter import RowCounter
    from fieldnav.settings.camera import CameraSettings
    from fieldnav.settings.crop import CropProfile

PART = "frames"
MOST_MISSING = 0.05
"""Share of a video's frames that may be missing unsaid: its head need not be exact."""
SAID_AT_MOST = 10
"""Frames that are named when they could not be placed."""


def count(
    frames: Annotated[
        str, typer.Argument(help="Folder of pictures, sorted by name, or a video.", metavar="FRAMES")
    ],
    direction: Annotated[
        Side | None,
        typer.Option(
            help="The way the robot moves, seen as the camera looks; rows that pass so count up. "
            "Without it: the way it moves on the whole, so that the count is not negative."
        ),
    ] = None,
    crop: Annotated[
        str | None, typer.Option(help="Crop profile; name or path. Without one: rows of any spacing.")
    ] = None,
    robot: RobotOption = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object, for programs.")] = False,
) -> None:
    """Count the crop rows that pass while the robot moves sideways.

    A row is crossed in the first frame in which its line has passed the image's centre column at mid-height;
    when it goes back, that is undone. Frames are counted from 0.

    Rows are told by the plants that the camera sees: one that has none in view does not count.
    """
    limit_pictures()  # a picture's head may claim any size, which is allocated at once
    # Here, because other commands need not wait for OpenCV.
    from fieldnav.cli.frames import frames_of  # noqa: PLC0415
    from fieldnav.settings.loading import load_crop, load_robot  # noqa: PLC0415

    profile = None if crop is None else load_crop(crop)
    camera = None if robot is None else load_robot(robot).cameras.front
    source = frames_of(frames)
    counter, dark = _counted(source, profile, camera)
    seen = len(dark)
    result = counter.result(direction)
    if as_json:
        print(json_of({"rows_crossed": result.rows_crossed, "frames": list(result.frames)}))
    else:
        _print_table(frames, result, seen)
    if seen < (1 - MOST_MISSING) * source.expected:
        print_warning(f"{frames}: gave {seen} of its {source.expected} frames: it is cut or damaged")
    if any(dark):
        known = "too dark or too bright for a robot to go by"
        print_warning(f"{frames}: {known}: frames {_named([at for at, each in enumerate(dark) if each])}")
    if counter.unplaced:
        known = "show no ground known from the frames before, so taken as on the way"
        print_warning(f"{frames}: {known}: {_named(counter.unplaced)}")


def _counted(
    frames: "Frames", crop: "CropProfile | None", camera: "CameraSettings | None"
) -> "tuple[RowCounter, list[bool]]":
    """All frames taken in, and of each whether it is too dark or too bright to go by.

    With a progress bar on the terminal, quiet where there is none.
    """
    with watched() as tell:
        return _taken_in(frames, crop, camera, tell)


def _taken_in(
    frames: "Frames",
    crop: "CropProfile | None",
    camera: "CameraSettings | None",
    tell: Progress,
) -> "tuple[RowCounter, list[bool]]":
    from fieldnav.cli.pictures import unlit  # noqa: PLC0415 - the same
    from fieldnav.perception.counting.row_counter import RowCounter  # noqa: PLC0415 - loads OpenCV
    from fieldnav.settings.loading import revised  # noqa: PLC0415 - the same

    counter: RowCounter | None = None
    dark: list[bool] = []
    top = 0
    for name, image in frames.images:
        if counter is None:
            height, width = image.shape[:2]
            size = {"width_px": width, "height_px": height}
            pinhole = None if camera is None else revised(camera, size, name).pinhole()
            top = 0 if pinhole is None else ceil(pinhole.top_px)
            # With the horizon in view the ground alone is looked at; how rows run together there is found.
            counter = RowCounter(crop, None if top else pinhole)
        counter.add(image[top:])
        dark.append(bool(unlit(image)))
        tell(PART, len(dark), max(frames.expected, len(dark)))
    assert counter is not None, "a source without frames is refused where it is read"
    return counter, dark


def _print_table(source: str, result: "RowCount", seen: int) -> None:
    moved = f"{result.direction.value} counts up"
    net = result.rows_crossed
    rows, frames = "row" if abs(net) == 1 else "rows", "frame" if seen == 1 else "frames"
    print_line(f"{source}: {net} {rows} crossed in {seen} {frames}, {moved}")
    columns = ("frame", "row", "robot moves", "count")
    lines, running = [], 0
    for passage in result.passages:
        running += result.step(passage)
        lines.append((str(passage.frame), str(passage.row + 1), passage.moved.value, f"{running:+d}"))
    if lines:
        out().print(table("", columns, lines, right=("frame", "row", "count")))


def _named(frames: Sequence[int]) -> str:
    return ", ".join(map(str, frames[:SAID_AT_MOST])) + (", ..." if len(frames) > SAID_AT_MOST else "")
