"""`fieldnav log report`: a run's report.html, made anew from its directory."""

from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.console import print_line
from fieldnav.cli.log.options import RUNS, RunArgument, RunsOption
from fieldnav.cli.output_folder import output_path
from fieldnav.journal.directory import find_run


def report(
    run: RunArgument = "last",
    runs: RunsOption = RUNS,
    out: Annotated[
        Path | None,
        typer.Option(
            parser=output_path,
            metavar="FILE",
            help="The file to write, instead of report.html in the run's directory.",
        ),
    ] = None,
) -> None:
    """Write a run's report.html: outcome, map, lanes, stops and near misses with pictures, settings."""
    from fieldnav.report.writing import write_report  # noqa: PLC0415 - other commands need not wait for it

    print_line(str(write_report(find_run(run, runs), out)))
