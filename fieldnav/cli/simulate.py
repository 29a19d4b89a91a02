"""fieldnav simulate: the field mission on a simulated robot in a simulated field."""

import json
import sys
import time
from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.live import Live
from rich.text import Text

from fieldnav.cli.console import out, table
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.summary import Summary
from fieldnav.messages import Side
from fieldnav.mission.loop import Tick
from fieldnav.mission.simulated import Run
from fieldnav.mission.simulated import simulate as drive
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_field, load_robot
from states.names import text

STOPPED = 1
"""Exit status of a mission that ended before its field did."""
REDRAW_S = 0.25


class SideOption(Enum):
    RIGHT = "right"
    LEFT = "left"


def simulate(
    field: Annotated[str, typer.Argument(help="A shipped field's name, or the path of your own.")] = "demo",
    crop: Annotated[str | None, typer.Option(help="Another crop in this field; name or path.")] = None,
    robot: Annotated[str, typer.Option(help="Robot; name or path.")] = "bonnbot",
    lanes: Annotated[int | None, typer.Option(min=1, max=100, help="Lanes to drive.")] = None,
    length: Annotated[float | None, typer.Option(min=4, max=2000, help="Length of the lanes, m.")] = None,
    side: Annotated[SideOption, typer.Option(help="Where the next lanes lie, seen forward.")] = SideOption.RIGHT,
    seed: Annotated[int | None, typer.Option(min=0, help="Another field of the same kind.")] = None,
    out_dir: Annotated[Path, typer.Option("--out", help="Folder that run directories are made in.")] = Path("runs"),
    video: Annotated[bool, typer.Option("--video", help="Write overlay.mp4 too.")] = False,
    realtime: Annotated[bool, typer.Option("--realtime", help="No faster than the clock.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print summary.json and nothing else.")] = False,
) -> int:
    """Drive a whole field in simulation: the real mission, driver and CAN frames, rendered cameras."""
    settings = _changed(load_field(field), crop=crop, lanes=lanes, length_m=length, seed=seed)
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
        print(json.dumps({"run": str(directory.path), **summary.model_dump(mode="json")}))
    else:
        directory, summary = _drive_watched(run)
        _report(directory, summary)
    return 0 if summary.completed else STOPPED


def _changed(field: FieldSettings, **options: str | int | float | None) -> FieldSettings:
    """The field with the options that were given, checked like the file itself."""
    given = {key: value for key, value in options.items() if value is not None}
    return FieldSettings.model_validate({**field.model_dump(), **given})


def _drive_watched(run: Run) -> tuple[RunDirectory, Summary]:
    """Drive with one live line on the terminal; quiet where there is none."""
    console = Console(stderr=True)
    if not sys.stderr.isatty():
        return drive(run)
    with Live(Text("setting up"), console=console, auto_refresh=False, transient=True) as live:
        return drive(run, [_LiveLine(live, run.lanes)])


class _LiveLine:
    """State, lane, rows, distance, speed and real-time factor, redrawn a few times a second."""

    def __init__(self, live: Live, lanes: int) -> None:
        self._live, self._lanes = live, lanes
        self._started = time.perf_counter()
        self._drawn = 0.0
        self._distance_m = 0.0
        self._at = (0.0, 0.0)

    def watch(self, tick: Tick) -> None:
        at = (tick.forward_m, tick.sideways_m)
        self._distance_m += abs(at[0] - self._at[0]) + abs(at[1] - self._at[1])
        self._at = at
        wall = time.perf_counter()
        if wall - self._drawn < REDRAW_S and tick.change is None:
            return
        self._drawn = wall
        twist = tick.passed.motion.twist
        line = Text.assemble(
            (f"{text(tick.state):32}", "bold"),
            f"lane {tick.lane}/{self._lanes}  rows {tick.rows}  {self._distance_m:6.1f} m  ",
            f"{abs(twist.vx_mps) + abs(twist.vy_mps):.2f} m/s  {tick.now_s:6.1f} s  ",
            f"{tick.now_s / (wall - self._started):.1f} x real time",
        )
        self._live.update(line, refresh=True)


def _report(directory: RunDirectory, summary: Summary) -> None:
    """The table at the end."""
    truth = summary.truth
    rows = [
        ("outcome", "finished" if summary.completed else "stopped before the end; see the last lines of the journal"),
        ("lanes", f"{summary.lanes.done} of {summary.lanes.total}"),
        ("distance", f"{summary.distance_m:.1f} m in {summary.duration_s:.0f} s"),
        ("speed of simulation", f"{summary.realtime_factor:.1f} x real time, {summary.wall_s:.0f} s"),
        ("switches", f"{summary.switches.succeeded} of {summary.switches.attempted}"),
        ("faults", str(summary.faults)),
    ]
    if summary.headland_m.mean is not None:
        rows.append(("headland used", f"{summary.headland_m.mean:.2f} m, at most {summary.headland_m.max:.2f} m"))
    if truth:
        track, heading = truth.cross_track_cm, truth.heading_deg
        rows += [
            ("cross-track error", f"{track.mean} +- {track.std} cm, 95 % within {track.p95}, at most {track.max}"),
            ("heading error", f"{heading.mean} +- {heading.std} deg, at most {heading.max}"),
            ("crop plants run over", str(truth.crop_plants_run_over)),
            ("lanes missed, repeated", f"{truth.lanes_missed}, {truth.lanes_repeated}"),
        ]
    console = out()
    console.print(table("", ("", ""), rows))
    console.print(f"run directory: {directory.path}")


