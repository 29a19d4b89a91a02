"""The files that a recording is made of: recording.mcap, recording-0002.mcap, and so on."""

import re
from pathlib import Path

from fieldnav.journal.directory import RunDirectory

LATER = re.compile(r"-(\d{4,})")
"""Of a piece after the first, between its stem and its suffix."""


def piece_path(directory: RunDirectory, number: int) -> Path:
    """Where a run's piece lies, counted from 1."""
    first = directory.recording
    return first if number == 1 else first.with_name(f"{first.stem}-{number:04}{first.suffix}")


def number_of(path: Path) -> int:
    """Of a piece, counted from 1, by its name."""
    later = LATER.search(path.stem)
    return int(later[1]) if later else 1


def pieces_in(directory: RunDirectory) -> dict[int, Path]:
    """The pieces of a run by their numbers, in order. Raises OSError."""
    first = directory.recording
    found = {1: first} if first.exists() else {}
    for path in directory.path.glob(f"{first.stem}-*{first.suffix}"):
        if number := LATER.fullmatch(path.stem.removeprefix(first.stem)):
            found[int(number[1])] = path
    return dict(sorted(found.items()))
