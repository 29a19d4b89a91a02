"""`fieldnav log plot`: a run over time as one picture."""

from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.console import print_line
from fieldnav.cli.log.options import RUNS, RunArgument, RunsOption
from fieldnav.cli.output_folder import output_path
from fieldnav.errors import SettingsError
from fieldnav.journal.directory import find_run

DEFAULT_NAME = "plot.png"
KINDS = (".png", ".svg")


def plot(
    run: RunArgument = "last",
    runs: RunsOption = RUNS,
    out: Annotated[
        Path | None,
        typer.Option(
            parser=output_path,
            metavar="FILE",
            help=f"The file to write, .png or .svg, instead of {DEFAULT_NAME} in the run's directory.",
        ),
    ] = None,
) -> None:
    """Plot a run over time: states, offset, heading, confidence, speed, rows counted; stops are marked."""
    from fieldnav.report.plot import write_plot  # noqa: PLC0415 - it loads matplotlib

    if out is not None and out.suffix.lower() not in KINDS:
        raise SettingsError(f"--out: '{out}': allowed is a file that ends in {' or '.join(KINDS)}")
    directory = find_run(run, runs)
    path = out or directory.path / DEFAULT_NAME
    notes = write_plot(directory, path)
    for line in (str(path), *notes):
        print_line(line)
