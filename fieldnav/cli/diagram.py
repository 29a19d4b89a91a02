"""`fieldnav diagram`: the state machine as a picture, made from the table it runs on; a run painted in."""

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.log.options import RUN_HELP, RUNS, RunsOption
from fieldnav.cli.output_folder import output_path
from fieldnav.errors import OutputError, SettingsError
from fieldnav.journal.directory import find_run
from fieldnav.journal.files import write_atomically


class Format(Enum):
    MERMAID = "mermaid"
    SVG = "svg"


def diagram(
    format: Annotated[
        Format | None,
        typer.Option(help="Mermaid text, or a picture as SVG.", show_default="mermaid; svg with --run"),
    ] = None,
    run: Annotated[
        str | None,
        typer.Option(help=f"Paint a run in: the time in each state, the transitions made. {RUN_HELP}"),
    ] = None,
    runs: RunsOption = RUNS,
    out: Annotated[
        Path | None,
        typer.Option(parser=output_path, metavar="FILE", help="Write it there instead of printing it."),
    ] = None,
) -> None:
    """Print the state machine's diagram, generated from the table that the machine runs on."""
    if run is not None and format is Format.MERMAID:
        raise SettingsError("--format: 'mermaid' cannot have a run painted in; allowed with --run is svg")
    made = _plain(format or Format.MERMAID) if run is None else _painted(run, runs)
    if out is None:
        print(made)
        return
    try:
        write_atomically(out, f"{made}\n".encode())
    except OutputError as error:
        raise OutputError(f"--out: {error}") from error


def _plain(format: Format) -> str:
    from states.diagram import mermaid, svg  # noqa: PLC0415 - other commands need not wait for the states

    return mermaid() if format is Format.MERMAID else svg()


def _painted(run: str, runs: Path) -> str:
    from fieldnav.cli.diagram_paint import paint_of  # noqa: PLC0415 - likewise
    from states.drawing.painted import painted  # noqa: PLC0415 - likewise

    return painted(paint_of(find_run(run, runs)))
