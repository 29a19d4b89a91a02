"""A run's transitions as a table in a file or on standard output."""

import csv
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TextIO

from fieldnav.inquiry.flat import Cell, columns, rows
from fieldnav.inquiry.lines import JournalLines
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Line
from fieldnav.journal.files import whole_file


def transitions_csv(directory: RunDirectory, target: Path | None) -> None:
    """One row a line of the journal; without a target on standard output. Raises FieldnavError."""
    with JournalLines(directory.journal) as journal:
        names = columns(_lines(journal))
        write_csv(target, names, rows(_lines(journal)))


def _lines(journal: JournalLines) -> Iterator[Line]:
    """Gone through twice rather than kept: a journal may be larger than the memory."""
    return (journal.parse(placed) for placed in journal.forwards())


def write_csv(target: Path | None, names: Sequence[str], table: Iterable[Mapping[str, Cell]]) -> None:
    """Write the whole table or nothing; without a target on standard output. Raises OutputError."""
    if target is None:
        _write(sys.stdout, names, table)
        return
    with whole_file(target) as beside, beside.open("w", encoding="utf-8", newline="") as file:
        _write(file, names, table)


def _write(file: TextIO, names: Sequence[str], table: Iterable[Mapping[str, Cell]]) -> None:
    writer = csv.DictWriter(file, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(table)
