"""`fieldnav diagram`: the state machine as a picture, made from the table it runs on."""

from enum import Enum
from typing import Annotated

import typer


class Format(Enum):
    MERMAID = "mermaid"
    SVG = "svg"


def diagram(
    format: Annotated[Format, typer.Option(help="Mermaid text, or a picture as SVG.")] = Format.MERMAID,
) -> None:
    """Print the state machine's diagram, generated from the table that the machine runs on."""
    from states.diagram import mermaid, svg  # noqa: PLC0415 - other commands need not wait for the states

    print(mermaid() if format is Format.MERMAID else svg())
