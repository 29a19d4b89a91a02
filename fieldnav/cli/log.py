"""`fieldnav log`: the runs there are, and what happened in one, with the reason for each transition."""

from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.console import out, print_json
from fieldnav.cli.log_tables import heading, runs_table, transitions_table
from fieldnav.journal.directory import find_run, runs_in
from fieldnav.journal.journal import read
from fieldnav.journal.outcome import overview

log = typer.Typer(name="log", no_args_is_help=True, help="Read what past runs did, and why.")

RUNS = Path("runs")

RunsOption = Annotated[Path, typer.Option("--runs", help="The folder that holds the runs.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON, for programs.")]


@log.command("list")
def list_runs(runs: RunsOption = RUNS, json: JsonOption = False) -> None:
    """List the runs, newest first, with how each ended."""
    overviews = [overview(run) for run in runs_in(runs)]
    if json:
        print_json([each.model_dump(mode="json") for each in overviews])
    elif overviews:
        out().print(runs_table(str(runs), overviews))
    else:
        print(f"no runs in {runs}; make one with: fieldnav simulate demo")


@log.command()
def show(
    run: Annotated[
        str, typer.Argument(help="A run's name, its path, or 'last'; of a part of a name, the newest run.")
    ] = "last",
    runs: RunsOption = RUNS,
    json: JsonOption = False,
) -> None:
    """Show a run's transitions: when, from where to where, on which event, and why."""
    directory = find_run(run, runs)
    lines = read(directory.journal)
    if json:
        print_json([line.model_dump(mode="json") for line in lines])
        return
    console = out()
    console.print(heading(overview(directory)))
    console.print(transitions_table(lines))
