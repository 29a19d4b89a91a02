"""`fieldnav simulate`: the field mission on a simulated robot in a simulated field."""

import json
import sys
from collections.abc import Callable
from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.console import out, print_json, print_line, watching
from fieldnav.cli.output_folder import output_path
from fieldnav.messages import Side
from fieldnav.mission.interruption import Interruption

if TYPE_CHECKING:
    from fieldnav.mission.simulated import Run, Simulated
    from fieldnav.settings.field import FieldSettings

STOPPED = 1
"""Exit status of a mission that ended before its field did, or left a lane out."""

LAST_PORT = 65534
"""The pictures of a served robot take the next one, and there are no more than 65535."""

OPTIONS = {"crop": "--crop", "lanes": "--lanes", "length_m": "--length", "seed": "--seed"}
"""The field's keys that options change."""


class SideOption(Enum):
    RIGHT = "right"
    LEFT = "left"


def simulate(
    field: Annotated[str, typer.Argument(help="A shipped field's name, or the path of your own.")] = "demo",
    crop: Annotated[str | None, typer.Option(help="Another crop in this field; name or path.")] = None,
    robot: Annotated[str, typer.Option(help="Robot; name or path.")] = "bonnbot",
    lanes: Annotated[int | None, typer.Option(help="Lanes to drive, 1 to 100.")] = None,
    length: Annotated[float | None, typer.Option(help="Length of the lanes, 4 to 2000 m.")] = None,
    side: Annotated[
        SideOption, typer.Option(help="Where the next lanes lie, seen forward.")
    ] = SideOption.RIGHT,
    seed: Annotated[int | None, typer.Option(help="Another field of the same kind.")] = None,
    out_dir: Annotated[
        Path,
        typer.Option(
            "--out", parser=output_path, help="Folder that run directories are made in.", metavar="DIR"
        ),
    ] = Path("runs"),
    video: Annotated[bool, typer.Option("--video", help="Write overlay.mp4 too.")] = False,
    realtime: Annotated[bool, typer.Option("--realtime", help="No faster than the clock.")] = False,
    sketch: Annotated[
        bool, typer.Option("--sketch", help="Draw plants as bare stars: faster, to try settings.")
    ] = False,
    record: Annotated[bool, typer.Option(help="Write recording.mcap; replaying the run needs it.")] = True,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")] = False,
    serve: Annotated[
        bool, typer.Option("--serve", help="Drive nothing: offer the robot on this machine, in real time.")
    ] = False,
    port: Annotated[
        int, typer.Option(min=0, max=LAST_PORT, help="Of the served bus; pictures on the next. 0: any.")
    ] = 0,
    robot_file: Annotated[
        Path,
        typer.Option(
            parser=output_path, help="Where --serve writes the robot file to drive it by.", metavar="FILE"
        ),
    ] = Path("served-robot.yaml"),
) -> int:
    """Drive a whole field in simulation: the real mission, driver and CAN frames, rendered cameras.

    With --serve: the same robot for another process, say fieldnav run, until Ctrl-C. With --json it then
    prints two lines: where everything is, and in the end what the robot truly did.
    """
    settings = _field(field, {"crop": crop, "lanes": lanes, "length_m": length, "seed": seed})
    if serve:
        from fieldnav.cli.serve import refuse, serve_robot  # noqa: PLC0415 - see _run

        refuse({"--video": video, "--realtime": realtime})
        return serve_robot(settings, robot, Side(side.value), port, sketch, robot_file, as_json)
    run = replace(
        _run(settings, robot, Side(side.value), out_dir, video, realtime), sketch=sketch, record=record
    )
    with Interruption() as interruption:
        drive = _drive_for_programs if as_json else _drive_for_people
        return drive(run, lambda: interruption.asked)


def _field(name: str, given: "dict[str, str | float | None]") -> "FieldSettings":
    """The field as the options change it. Raises SettingsError."""
    from fieldnav.settings.loading import load_field, revised  # noqa: PLC0415 - see _run

    changes = {key: value for key, value in given.items() if value is not None}
    return revised(load_field(name), changes, label="", called=OPTIONS)


def _run(field: "FieldSettings", robot: str, side: Side, parent: Path, video: bool, realtime: bool) -> "Run":
    """What is to be driven. Raises SettingsError where a file is wrong or two of them do not go together."""
    # Here, because other commands need not wait for what drives.
    from fieldnav.mission.simulated import Run  # noqa: PLC0415
    from fieldnav.settings.loading import check_size, load_crop, load_robot  # noqa: PLC0415

    crop = load_crop(field.crop)
    check_size(field, crop)
    return Run(field, crop, load_robot(robot), field.lanes, side, parent, video, realtime)


def _drive_for_programs(run: "Run", stopping: Callable[[], bool]) -> int:
    """Drive and print the figures as JSON; returns the exit status."""
    from fieldnav.cli.mission_report import reported, succeeded  # noqa: PLC0415 - see _run
    from fieldnav.journal.summary import to_json  # noqa: PLC0415
    from fieldnav.mission.simulated import simulate as drive  # noqa: PLC0415

    done = drive(run, stopping=stopping)
    reported(done.directory)
    print_json({"run": str(done.directory.path), **json.loads(to_json(done.summary))})
    return 0 if succeeded(done.summary) else STOPPED


def _drive_for_people(run: "Run", stopping: Callable[[], bool]) -> int:
    """Drive and print a table; returns the exit status."""
    from fieldnav.cli.mission_report import report, reported, succeeded  # noqa: PLC0415 - see _run

    done = _drive_watched(run, stopping)
    reported(done.directory)
    out().print(report(done.directory, done.summary))
    print_line(f"run directory: {done.directory.path}")
    return 0 if succeeded(done.summary) else STOPPED


def _drive_watched(run: "Run", stopping: Callable[[], bool]) -> "Simulated":
    """Drive with one live line on the terminal; quiet where there is none."""
    from rich.live import Live  # noqa: PLC0415
    from rich.text import Text  # noqa: PLC0415

    from fieldnav.cli.live_line import LiveLine  # noqa: PLC0415
    from fieldnav.mission.simulated import simulate as drive  # noqa: PLC0415

    if not sys.stderr.isatty():
        return drive(run, stopping=stopping)
    with Live(Text("setting up"), console=watching(), auto_refresh=False, transient=True) as live:
        return drive(run, [LiveLine(live, run.lanes)], stopping)
