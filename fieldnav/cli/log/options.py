"""Options that the commands of `fieldnav log` share."""

from pathlib import Path
from typing import Annotated

import typer

RUNS = Path("runs")
RUN_HELP = "A run's name, its path, or 'last'; of a part of a name, the newest run."

RunArgument = Annotated[str, typer.Argument(help=RUN_HELP)]
RunsOption = Annotated[Path, typer.Option("--runs", help="The folder that holds the runs.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON, for programs.")]
