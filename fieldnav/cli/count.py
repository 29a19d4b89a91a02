"""`fieldnav count`: the rows that pass sideways in a folder of frames or a video."""

import json
import os
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.console import out, table
from fieldnav.messages import Side
from fieldnav.settings.robot import LARGEST_SIDE_PX

if TYPE_CHECKING:
    from fieldnav.cli.frames import Frames
    from fieldnav.perception.counting.row_count import RowCount
    from fieldnav.perception.counting.row_counter import RowCounter
    from fieldnav.settings.crop import CropProfile
    from fieldnav.settings.robot import CameraSettings

PART = "frames"
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
    robot: Annotated[
        str | None,
        typer.Option(
            help="Robot whose front camera took them; name or path. Without one: the camera is estimated."
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object, for programs.")] = False,
) -> None:
    """Count the crop rows that pass while the robot moves sideways.

    A row is crossed in the first frame in which its line has passed the image's centre column at mid-height;
    when it goes back, that is undone. Frames are counted from 0.

    Rows are told by the plants that the camera sees: one that has none in view does not count.
    """
    # OpenCV reads this when it is loaded: a picture's head may claim any size, which is allocated at once.
    os.environ.setdefault("OPENCV_IO_MAX_IMAGE_PIXELS", str(LARGEST_SIDE_PX**2))
    # Here, because other commands need not wait for OpenCV.
    from fieldnav.cli.frames import frames_of  # noqa: PLC0415
    from fieldnav.settings.loading import load_crop, load_robot  # noqa: PLC0415

    profile = None if crop is None else load_crop(crop)
    camera = None if robot is None else load_robot(robot).cameras.front
    counter = _counted(frames_of(frames), profile, camera)
    result = counter.result(direction)
    if as_json:
        print(json.dumps({"rows_crossed": result.rows_crossed, "frames": list(result.frames)}))
    else:
        _print_table(frames, result)
    _warn(frames, counter.unplaced)


def _counted(frames: "Frames", crop: "CropProfile | None", camera: "CameraSettings | None") -> "RowCounter":
    """All frames taken in, with a progress bar on the terminal; quiet where there is none."""
    if not sys.stderr.isatty():
        return _taken_in(frames, crop, camera, lambda part, done, steps: None)
    from fieldnav.cli.bench_progress import PartBars  # noqa: PLC0415 - only for a person who watches

    with PartBars() as bars:
        return _taken_in(frames, crop, camera, bars.tell)


def _taken_in(
    frames: "Frames",
    crop: "CropProfile | None",
    camera: "CameraSettings | None",
    tell: Callable[[str, int, int], None],
) -> "RowCounter":
    from fieldnav.perception.counting.row_counter import RowCounter  # noqa: PLC0415 - loads OpenCV
    from fieldnav.settings.loading import revised  # noqa: PLC0415 - the same

    counter: RowCounter | None = None
    for number, (name, image) in enumerate(frames.images):
        if counter is None:
            height, width = image.shape[:2]
            size = {"width_px": width, "height_px": height}
            pinhole = None if camera is None else revised(camera, size, name).pinhole()
            counter = RowCounter(crop, pinhole)
        counter.add(image)
        tell(PART, number + 1, max(frames.expected, number + 1))
    assert counter is not None, "a source without frames is refused where it is read"
    return counter


def _print_table(source: str, result: "RowCount") -> None:
    moved = f"{result.direction.value} counts up"
    net = result.rows_crossed
    print(f"{source}: {net} row{'' if abs(net) == 1 else 's'} crossed, {moved}")
    columns = ("frame", "row", "robot moves", "count")
    rows, running = [], 0
    for passage in result.passages:
        running += result.step(passage)
        rows.append((str(passage.frame), str(passage.row + 1), passage.moved.value, f"{running:+d}"))
    if rows:
        out().print(table("", columns, rows, right=("frame", "row", "count")))


def _warn(source: str, unplaced: tuple[int, ...]) -> None:
    if not unplaced:
        return
    named = ", ".join(map(str, unplaced[:SAID_AT_MOST])) + (", ..." if len(unplaced) > SAID_AT_MOST else "")
    line = f"warning: {source}: show no ground known from the frames before, so taken as on the way: {named}"
    print(line, file=sys.stderr)
