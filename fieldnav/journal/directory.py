"""A run's directory: one folder a run, named by its time and what was driven, and what lies where in it."""

import os
import re
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Self

from fieldnav.errors import FieldnavError, OutputError
from fieldnav.journal.files import PRIVATE_FOLDER
from fieldnav.settings.regular_file import open_regular

MOST_RUNS_A_SECOND = 1000
"""Runs of one name that may start within a second before something else must be wrong."""
NUMBER, HEAD_BYTES = re.compile(rb"^run: ([0-9]{1,9})$", re.MULTILINE), 1024
"""A run's number, in the head of its settings.yaml."""


@dataclass(frozen=True, slots=True)
class RunDirectory:
    """The paths of one run's files; making this object touches nothing, `create` makes the folder."""

    path: Path

    @classmethod
    def create(cls, parent: Path, name: str, utc: datetime) -> Self:
        """Make `parent`/<UTC time>-`name`/, never one that exists. Raises OutputError, leaving nothing."""
        stem = f"{utc.astimezone(UTC):%Y%m%dT%H%M%SZ}-{name}"
        made = _make_folders(parent)
        for attempt in range(1, MOST_RUNS_A_SECOND):
            path = parent / (stem if attempt == 1 else f"{stem}-{attempt}")
            try:
                path.mkdir(PRIVATE_FOLDER)
            except FileExistsError:
                continue
            except OSError as error:
                _remove(made)
                raise _unwritable(parent, error) from error
            return cls(path)
        raise OutputError(f"{parent}: holds {MOST_RUNS_A_SECOND} runs named {stem} already")

    @property
    def number(self) -> int:
        """By which runs of a folder are in the order in which they were made; 0 where none is written."""
        try:
            with open_regular(self.settings) as file:
                found = NUMBER.search(file.read(HEAD_BYTES))
        except OSError:
            return 0
        return int(found[1]) if found else 0

    @property
    def journal(self) -> Path:
        return self.path / "journal.jsonl"

    @property
    def summary(self) -> Path:
        return self.path / "summary.json"

    @property
    def settings(self) -> Path:
        return self.path / "settings.yaml"

    @property
    def ledger(self) -> Path:
        return self.path / "ledger.jsonl"

    @property
    def can_log(self) -> Path:
        return self.path / "can.log"

    @property
    def recording(self) -> Path:
        return self.path / "recording.mcap"

    @property
    def report(self) -> Path:
        return self.path / "report.html"

    @property
    def map(self) -> Path:
        return self.path / "map.png"

    @property
    def overlay(self) -> Path:
        return self.path / "overlay.mp4"


def runs_in(parent: Path) -> list[RunDirectory]:
    """The runs below a folder, that made last first; none when there is no such folder.

    By their numbers, since a robot's clock may be wrong; after them runs without one, by the time in their
    names. Raises FieldnavError for what is no folder that can be read.
    """
    try:
        paths = list(parent.iterdir())
    except FileNotFoundError:
        return []
    except OSError as error:
        raise FieldnavError(
            f"{parent}: cannot be read: {error.strerror}; allowed is a folder that holds runs"
        ) from error
    runs = [run for run in map(RunDirectory, paths) if os.path.exists(run.journal)]
    return sorted(runs, key=lambda run: (run.number, run.path.name), reverse=True)


def next_number(parent: Path) -> int:
    """The number of the run that is made next in a folder."""
    try:
        return max((RunDirectory(path).number for path in parent.iterdir()), default=0) + 1
    except OSError:  # a folder that may be written, but not be listed
        return 1


def find_run(name_or_path: str, parent: Path) -> RunDirectory:
    """The run that 'last', a path, or a name stands for; of a part, the newest. Raises FieldnavError."""
    given = RunDirectory(Path(name_or_path))
    if name_or_path != "last" and os.path.exists(given.journal):  # which no name is too long for
        return given
    runs = runs_in(parent)
    if name_or_path == "last":
        if not runs:
            raise FieldnavError(f"{parent}: holds no runs; allowed is the path of a run's directory")
        return runs[0]
    if matching := [run for run in runs if name_or_path and name_or_path in run.path.name]:
        return next((run for run in matching if run.path.name == name_or_path), matching[0])
    raise FieldnavError(
        f"no run '{name_or_path}' in {parent}; allowed is last, a name of `fieldnav log list`, or a path"
    )


def _make_folders(parent: Path) -> list[Path]:
    """Make `parent` and what lacks above it; returns what was made, deepest first."""
    made: list[Path] = []
    lacking = [folder for folder in (parent, *parent.parents) if not os.path.exists(folder)]
    for folder in reversed(lacking):
        try:
            folder.mkdir(PRIVATE_FOLDER, exist_ok=True)
        except OSError as error:
            _remove(made)
            raise _unwritable(parent, error) from error
        made.insert(0, folder)
    return made


def _remove(folders: list[Path]) -> None:
    for folder in folders:
        with suppress(OSError):  # another program has put something there meanwhile
            folder.rmdir()


def _unwritable(parent: Path, error: OSError) -> OutputError:
    return OutputError(
        f"{parent}: no run directory can be made here: {error.strerror}; allowed is a folder you can write"
    )
