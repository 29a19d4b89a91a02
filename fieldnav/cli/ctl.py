"""`fieldnav ctl`: a word to a running mission from a second terminal."""

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from fieldnav.cli.console import out, print_error, print_json, print_line, table
from fieldnav.operator.caller import ask, running
from fieldnav.operator.choosing import choose, driven_in
from fieldnav.operator.request import Command
from fieldnav.operator.socket_place import SocketPlace
from fieldnav.operator.status import Status

REFUSED = 1
"""Exit status of what the mission would not do."""
MILLISECONDS = 1000

ctl = typer.Typer(
    name="ctl",
    no_args_is_help=True,
    help="Speak to a running mission: pause, resume, stop, reset, status. Exit status: 0 when it was done, "
    "1 when the mission refuses, 2 when no mission is running.",
)

RunOption = Annotated[
    str | None,
    typer.Option("--run", help="Which mission, where several run: its name, a part of it, its path, 'last'."),
]
RunsOption = Annotated[
    Path | None, typer.Option("--runs", help="Only missions whose run directory is made in this folder.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object, for programs.")]


@ctl.command()
def pause(run: RunOption = None, runs: RunsOption = None, json: JsonOption = False) -> int:
    """Stop the wheels and wait; `resume` goes on from there."""
    return _say(Command.PAUSE, run, runs, json)


@ctl.command()
def resume(run: RunOption = None, runs: RunsOption = None, json: JsonOption = False) -> int:
    """Go on after a pause or a recoverable fault, or say yes to what the mission asks."""
    return _say(Command.RESUME, run, runs, json)


@ctl.command()
def stop(run: RunOption = None, runs: RunsOption = None, json: JsonOption = False) -> int:
    """Stop the wheels and end the mission."""
    return _say(Command.STOP, run, runs, json)


@ctl.command()
def reset(run: RunOption = None, runs: RunsOption = None, json: JsonOption = False) -> int:
    """Clear a fault, a latched one too; only when its cause has been seen to."""
    return _say(Command.RESET, run, runs, json)


@ctl.command()
def status(run: RunOption = None, runs: RunsOption = None, json: JsonOption = False) -> int:
    """Show the state, lane, speed and warnings of the mission."""
    return _say(Command.STATUS, run, runs, json)


def _say(command: Command, run: str | None, runs: Path | None, as_json: bool) -> int:
    """Ask and print what came of it; returns the exit status. Raises FieldnavError without an answer."""
    sockets = running(SocketPlace())
    path = choose(sockets if runs is None else driven_in(sockets, runs), run)
    answer = ask(path, command)
    if as_json:
        print_json({"run": path.stem, **asdict(answer)})
    elif not answer.ok:
        print_error(f"{path.stem}: {answer.said}")
    elif answer.status is not None:
        out().print(status_table(answer.status))
    else:
        print_line(f"{path.stem}: {answer.said}")
    return 0 if answer.ok else REFUSED


def status_table(status: Status) -> Table:
    """A line a quantity; those that nobody knows or that say nothing are left out."""
    lateness_ms = None if status.lateness_s is None else status.lateness_s * MILLISECONDS
    rows = [
        ("state", f"{status.state}{_figure(status.since_s, ' for {:.1f} s')}"),
        ("because", status.reason),
        ("lane", f"{status.lane} of {status.lanes}, rows {status.rows}"),
        ("distance", _figure(status.distance_m, "{:.1f} m")),
        ("speed", _figure(status.speed_mps, "{:.2f} m/s")),
        ("battery", _figure(status.battery_percent, "{:.0f} %")),
        ("loop", _figure(lateness_ms, "{:.1f} ms late at worst")),
        *(("warning", warning) for warning in status.warnings),
    ]
    return table(status.run, ("", ""), [row for row in rows if row[1]])


def _figure(value: float | None, shape: str) -> str:
    return "" if value is None else shape.format(value)
