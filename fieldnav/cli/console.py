"""Where commands print: people read tables on standard output, errors go to standard error as plain lines."""

import json
import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import IO, Any, TextIO, cast

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment
from rich.table import Table
from rich.text import Text

from fieldnav.settings.one_line import one_line

FAILED = 2
"""Exit status of wrong input, and of output that cannot be written; a mission that stops exits with 1."""

PLAIN_WIDTH = 200
"""Columns of a table that goes into a file or a pipe, where no terminal sets a width."""


class SafeConsole(Console):
    """A console that writes out what would move the cursor, set the title or turn the text around.

    Names and reasons come from files, which anybody may have written; in square brackets they are no markup.
    """

    def __init__(self, width: int | None = None, file: IO[str] | None = None) -> None:
        super().__init__(width=width, file=file, highlight=False, markup=False, emoji=False)

    def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterable[Segment]:
        if isinstance(renderable, str):
            renderable = Text(renderable)
        return super().render(self._safe(renderable) if isinstance(renderable, Text) else renderable, options)

    def _safe(self, text: Text) -> Text:
        lines = text.plain.split("\n")
        if all(line.isprintable() for line in lines):
            return text
        parts = [(_lines(segment.text), segment.style or "") for segment in text.render(self)]
        safe = Text.assemble(*parts, end=text.end, justify=text.justify, overflow=text.overflow)
        safe.no_wrap = text.no_wrap
        return safe


def _lines(text: str) -> str:
    return "\n".join(map(one_line, text.split("\n")))


def out() -> Console:
    """The console for what a person reads; without colours and wide when it is no terminal."""
    return SafeConsole(None if sys.stdout.isatty() else PLAIN_WIDTH)


class _StandardError:
    """Standard error for what is shown on the way: nothing comes of it when its terminal is gone."""

    def write(self, text: str) -> int:
        try:
            return sys.stderr.write(text)
        except OSError:
            drop(sys.stderr)
            return len(text)

    def flush(self) -> None:
        try:
            sys.stderr.flush()
        except OSError:
            drop(sys.stderr)

    def __getattr__(self, name: str) -> Any:
        return getattr(sys.stderr, name)


def watching() -> Console:
    """The console of what is shown while a command works, on standard error; a robot drives on without it."""
    return SafeConsole(file=cast(IO[str], _StandardError()))


def table(
    title: str, columns: Sequence[str], rows: Sequence[Sequence[str | Text]], right: Sequence[str] = ()
) -> Table:
    """A table without vertical rules; the columns named in `right` hold figures.

    Titles and cells are shown as they are: a square bracket in a file's name is no markup.
    """
    shown = Text(one_line(title), style="bold") if title else None
    made = Table(title=shown, title_justify="left", box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in columns:
        made.add_column(
            column, justify="right" if column in right else "left", header_style="dim", overflow="fold"
        )
    for row in rows:
        made.add_row(*(cell if isinstance(cell, Text) else Text(_lines(cell)) for cell in row))
    return made


def json_of(value: Mapping[str, Any] | Sequence[Any], indent: int | None = None) -> str:
    """A JSON document in characters that every terminal and every encoding can show."""
    return json.dumps(value, indent=indent).replace("\x7f", "\\u007f")


def print_json(value: Mapping[str, Any] | Sequence[Any]) -> None:
    """One JSON document on standard output, for programs."""
    print(json_of(value, indent=2))


def print_line(line: str) -> None:
    """One line on standard output, whatever the names in it hold."""
    print(one_line(line))


def print_error(line: str) -> None:
    """One plain line on standard error, whatever the terminal."""
    _tell("error", line)


def print_warning(line: str) -> None:
    """The same, for what does not end a command."""
    _tell("warning", line)


def drop(stream: TextIO) -> None:
    """Let go of a stream: what could not be written must not be tried again, not even at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _tell(kind: str, line: str) -> None:
    """Say it where anybody listens; a command is none the worse for it where nobody does."""
    try:
        print(f"{kind}: {one_line(' '.join(line.split()))}", file=sys.stderr, flush=True)
    except OSError:
        drop(sys.stderr)
