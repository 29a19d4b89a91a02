"""`fieldnav simulate`: the field mission on a simulated robot in a simulated field."""

import json
import sys
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fieldnav.cli.console import out, print_json, table
from fieldnav.messages import Side

if TYPE_CHECKING:
    from fieldnav.journal.directory import RunDirectory
    from fieldnav.journal.summary import Summary
    from fieldnav.mission.simulated import Run

STOPPED = 1
"""Exit status of a mission that ended before its field did."""


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
        Path, typer.Option("--out", help="Folder that run directories are made in.", metavar="DIR")
    ] = Path("runs"),
    video: Annotated[bool, typer.Option("--video", help="Write overlay.mp4 too.")] = False,
    realtime: Annotated[bool, typer.Option("--realtime", help="No faster than the clock.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print summary.json and nothing else.")] = False,
) -> int:
    """Drive a whole field in simulation: the real mission, driver and CAN frames, rendered cameras."""
    # Here, because other commands need not wait for what drives.
    from fieldnav.journal.summary import to_json  # noqa: PLC0415
    from fieldnav.mission.simulated import Run  # noqa: PLC0415
    from fieldnav.mission.simulated import simulate as drive  # noqa: PLC0415
    from fieldnav.settings.loading import load_crop, load_field, load_robot, revised  # noqa: PLC0415

    given = {"crop": crop, "lanes": lanes, "length_m": length, "seed": seed}
    changes: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    settings = revised(load_field(field), changes)
    run = Run(
        field=settings,
        crop=load_crop(settings.crop),
        robot=load_robot(robot),
        lanes=settings.lanes,
        side=Side(side.value),
        parent=out_dir,
        video=video,
        realtime=realtime,
    )
    if as_json:
        directory, summary = drive(run)
        print_json({"run": str(directory.path), **json.loads(to_json(summary))})
    else:
        directory, summary = _drive_watched(run)
        _report(directory, summary)
    return 0 if summary.completed else STOPPED


def _drive_watched(run: "Run") -> "tuple[RunDirectory, Summary]":
    """Drive with one live line on the terminal; quiet where there is none."""
    from rich.console import Console  # noqa: PLC0415
    from rich.live import Live  # noqa: PLC0415
    from rich.text import Text  # noqa: PLC0415

    from fieldnav.cli.live_line import LiveLine  # noqa: PLC0415
    from fieldnav.mission.simulated import simulate as drive  # noqa: PLC0415

    if not sys.stderr.isatty():
        return drive(run)
    with Live(Text("setting up"), console=Console(stderr=True), auto_refresh=False, transient=True) as live:
        return drive(run, [LiveLine(live, run.lanes)])


def _report(directory: "RunDirectory", summary: "Summary") -> None:
    """The table at the end."""
    ended = "finished" if summary.completed else "stopped before the end; see the last lines of the journal"
    rows = [
        ("outcome", ended),
        ("lanes", f"{summary.lanes.done} of {summary.lanes.total}"),
        ("distance", f"{summary.distance_m:.1f} m in {summary.duration_s:.0f} s"),
        ("speed of simulation", f"{summary.realtime_factor:.1f} x real time, {summary.wall_s:.0f} s"),
        ("switches", f"{summary.switches.succeeded} of {summary.switches.attempted}"),
        ("faults", str(summary.faults)),
    ]
    used = summary.headland_m
    if used.mean is not None:
        rows.append(("headland used", f"{used.mean:.2f} m, at most {used.max:.2f} m"))
    if truth := summary.truth:
        track, heading = truth.cross_track_cm, truth.heading_deg
        off = f"{track.mean} +- {track.std} cm, 95 % within {track.p95}, at most {track.max}"
        rows += [
            ("cross-track error", off),
            ("heading error", f"{heading.mean} +- {heading.std} deg, at most {heading.max}"),
            ("crop plants run over", str(truth.crop_plants_run_over)),
            ("lanes missed, repeated", f"{truth.lanes_missed}, {truth.lanes_repeated}"),
        ]
    out().print(table("", ("", ""), rows))
    print(f"run directory: {directory.path}")
