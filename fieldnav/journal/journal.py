"""The journal: one JSON line a transition or notable event, on the disk before the wheels obey."""

import json
import os
from collections.abc import Callable
from contextlib import suppress
from datetime import datetime
from functools import partial
from pathlib import Path
from tempfile import TemporaryFile
from types import TracebackType
from typing import Any, Self

from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.faults import FaultKind, Trouble
from fieldnav.journal.entry import Entry, Line, line_of
from fieldnav.journal.files import append_line, private, unwritable
from fieldnav.settings.json_text import read_model
from fieldnav.settings.regular_file import open_regular

RESERVE_BYTES = 65536
"""Some fifty lines."""


class Journal:
    """Appends entries to a file; an existing journal is continued after its last whole line.

    Some room is kept on its disk: once that is full the room is given up, for the line that says so. It is a
    file without a name, which no process that is killed leaves behind.
    Raises OutputError when the file cannot be written.
    """

    def __init__(
        self, path: Path, start_utc: datetime, heard: Callable[[dict[str, Any]], None] | None = None
    ) -> None:
        """heard: is given each line, as plain JSON values, once it is on the disk."""
        self._heard = heard
        self._path = path
        self._start_utc = start_utc
        try:
            self._sequence = _repair(path)
            self._file = open(path, "ab", buffering=0, opener=private)  # noqa: SIM115 - closed by close
            self._reserve = TemporaryFile(buffering=0, dir=path.parent)  # noqa: SIM115 - until it is given up
            self._reserve.write(bytes(RESERVE_BYTES))
            _sync_folder(path.parent)
        except OSError as error:
            raise unwritable(path, error) from error

    def record(self, entry: Entry) -> None:
        """Append one line; on return it is on the disk.

        Raises OutputError; in the room that was kept the file then says so itself, instead of the line.
        """
        try:
            self._append(entry)
        except OSError as error:
            failed = unwritable(self._path, error)
            reason = str(Trouble(FaultKind.DISK_FULL, str(failed)))
            with suppress(OSError):
                self._reserve.close()
                self._append(
                    Entry(entry.stamp_s, FaultKind.DISK_FULL.value, entry.source, entry.source, reason=reason)
                )
            raise failed from error

    def _append(self, entry: Entry) -> None:
        """Raises OSError; the file then ends as before."""
        line = line_of(entry, self._sequence, self._start_utc)
        content = json.dumps(line, allow_nan=False).encode()
        append_line(self._file, content, partial(os.fsync, self._file.fileno()))
        self._sequence += 1
        if self._heard is not None:
            self._heard(line)

    def close(self) -> None:
        self._file.close()
        self._reserve.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def read(path: Path) -> list[Line]:
    """The lines of a journal; a last line torn by power loss is left out.

    Raises FieldnavError when the file cannot be read or another line is none of a journal's.
    """
    try:
        with open_regular(path) as file:
            content = file.read()
    except OSError as error:
        raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error
    *texts, torn = content.split(b"\n")  # no other line break: a stray one may not hide what follows it
    lines = []
    for number, text in enumerate(texts, start=1):
        try:
            lines.append(read_model(Line, text))
        except SettingsError as error:
            if number == len(texts) and not torn:
                break
            raise FieldnavError(f"{path}: line {number} is not a line of a journal: {error}") from error
    return lines


def _repair(path: Path) -> int:
    """Cut a torn last line off; returns the next sequence number. What was torn was never acted on."""
    if not path.exists():
        return 0
    with path.open("r+b") as file:
        content = file.read()
        file.truncate(content.rfind(b"\n") + 1)
    lines = read(path)
    return lines[-1].seq + 1 if lines else 0


def _sync_folder(folder: Path) -> None:
    """Sync a folder, so that the new file's name outlives a power loss too."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
