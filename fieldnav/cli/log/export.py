"""`fieldnav log export`: a run for other programs, as a table or as one MCAP file."""

from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.console import print_line
from fieldnav.cli.log.export_csv import transitions_csv
from fieldnav.cli.log.options import RUNS, RunArgument, RunsOption
from fieldnav.cli.output_folder import output_path
from fieldnav.errors import SettingsError
from fieldnav.journal.directory import find_run
from fieldnav.journal.files import check_replaceable

STANDARD_OUTPUT = Path("-")


def export(
    run: RunArgument = "last",
    csv: Annotated[
        Path | None,
        typer.Option(
            parser=output_path, metavar="FILE", help="Write a table to this file, - for standard output."
        ),
    ] = None,
    mcap: Annotated[
        Path | None,
        typer.Option(
            parser=output_path, metavar="FILE", help="Write one MCAP file: the recording, else the journal."
        ),
    ] = None,
    ticks: Annotated[
        bool, typer.Option("--ticks", help="In the table a row a tick of the recording, not a transition.")
    ] = False,
    force: Annotated[bool, typer.Option("--force", help="Overwrite a file that exists.")] = False,
    runs: RunsOption = RUNS,
) -> None:
    """Write a run's journal or recording for a spreadsheet, for Foxglove or PlotJuggler."""
    if (csv is None) == (mcap is None):
        raise SettingsError("export: allowed is either --csv FILE or --mcap FILE")
    if ticks and csv is None:
        raise SettingsError("--ticks: allowed with --csv only; an MCAP file has them already")
    directory = find_run(run, runs)
    if mcap is not None:
        from fieldnav.cli.log.export_mcap import export_mcap  # noqa: PLC0415 - slow to import

        export_mcap(directory, _free("--mcap", mcap, force))
        print_line(str(mcap))
        return
    assert csv is not None
    target = None if csv == STANDARD_OUTPUT else _free("--csv", csv, force)
    if ticks:
        from fieldnav.cli.log.export_ticks import ticks_csv  # noqa: PLC0415 - slow to import

        ticks_csv(directory, target)
    else:
        transitions_csv(directory, target)
    if target is not None:
        print_line(str(target))


def _free(option: str, path: Path, force: bool) -> Path:
    """The path, where nothing lies that would be lost. Raises SettingsError, OutputError."""
    if path == STANDARD_OUTPUT:
        raise SettingsError(f"{option}: '-': allowed is the name of a file")
    if path.is_dir() and not path.is_symlink():
        raise SettingsError(f"{option}: {path}: is a folder; allowed is the name of a file")
    check_replaceable(path)
    if path.exists() and not force:
        raise SettingsError(f"{option}: {path}: exists; allowed is another name, or --force")
    return path
