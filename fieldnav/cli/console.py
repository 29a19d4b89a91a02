"""Where commands print: people read tables on standard output, errors go to standard error as plain lines."""

import json
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

FAILED = 2
"""Exit status of wrong input, and of output that cannot be written; a mission that stops exits with 1."""

PLAIN_WIDTH = 200
"""Columns of a table that goes into a file or a pipe, where no terminal sets a width."""


def out() -> Console:
    """The console for what a person reads; without colours and wide when it is no terminal."""
    terminal = sys.stdout.isatty()
    return Console(width=None if terminal else PLAIN_WIDTH, highlight=False, soft_wrap=False)


def table(
    title: str, columns: Sequence[str], rows: Sequence[Sequence[str | Text]], right: Sequence[str] = ()
) -> Table:
    """A table without vertical rules; the columns named in `right` hold figures.

    Titles and cells are shown as they are: a square bracket in a file's name is no markup.
    """
    shown = Text(title, style="bold") if title else None
    made = Table(title=shown, title_justify="left", box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in columns:
        made.add_column(
            column, justify="right" if column in right else "left", header_style="dim", overflow="fold"
        )
    for row in rows:
        made.add_row(*(cell if isinstance(cell, Text) else Text(cell) for cell in row))
    return made


def print_json(value: Mapping[str, Any] | Sequence[Any]) -> None:
    """One JSON document on standard output, for programs."""
    print(json.dumps(value, indent=2, ensure_ascii=False))


def print_error(line: str) -> None:
    """One plain line on standard error, whatever the terminal."""
    print(f"error: {' '.join(line.split())}", file=sys.stderr)


def print_warning(line: str) -> None:
    """The same, for what does not end a command."""
    print(f"warning: {' '.join(line.split())}", file=sys.stderr)
