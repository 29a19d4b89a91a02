"""Journal and ledger that a copy of the process can go on with by itself, on a disk that can become full."""

import os
import shutil
from collections.abc import Callable
from datetime import datetime
from io import FileIO
from pathlib import Path

from fieldnav.journal.entry import Line
from fieldnav.journal.journal import Journal, read
from fieldnav.journal.ledger import Ledger
from fieldnav.mission.tape import Tape
from fieldnav.simulation.injection_disk import FullDisk

JOURNAL, LEDGER = "journal.jsonl", "ledger.jsonl"


class MovableJournal(Journal):
    """A forked process shares its open files with the other, who goes on writing: it needs its own."""

    def move_to(self, path: Path) -> None:
        shutil.copy(self._path, path)
        super().__init__(path, self._start_utc)

    def fill_disk(self) -> None:
        """From now on there is only the room that the journal keeps for its last words."""
        self._file = FullDisk(self._file, self.has_given_up)  # type: ignore[assignment]

    @property
    def sequence(self) -> int:
        return self._sequence

    def has_given_up(self) -> bool:
        """Whether the room for its last words is free for them."""
        return self._reserve.closed


class MovableLedger(Ledger):
    """The same for the ledger, which only one process may hold."""

    _file: FileIO

    def _sync(self, at_once: bool) -> None:
        """Always at once: a process that is to be copied may have one thread alone."""
        os.fdatasync(self._file.fileno())

    def move_to(self, path: Path) -> None:
        shutil.copy(self._path, path)
        super().__init__(path)

    def fill_disk(self, given_up: Callable[[], bool]) -> None:
        self._file = FullDisk(self._file, given_up)  # type: ignore[assignment]


class PaperTrail:
    """What a run writes down as it goes, in one folder."""

    def __init__(self, folder: Path, begun_utc: datetime, tape: Tape) -> None:
        self.folder = folder
        self.journal = MovableJournal(folder / JOURNAL, begun_utc, tape.line)
        self.ledger = MovableLedger(folder / LEDGER)

    def move_to(self, folder: Path) -> None:
        """Go on in another folder, with copies."""
        self.folder = folder
        self.journal.move_to(folder / JOURNAL)
        self.ledger.move_to(folder / LEDGER)

    def fill_disk(self) -> None:
        self.journal.fill_disk()
        self.ledger.fill_disk(self.journal.has_given_up)

    @property
    def sequence(self) -> int:
        """Lines of the journal so far."""
        return self.journal.sequence

    def lines(self) -> list[Line]:
        return read(self.folder / JOURNAL)

    def close(self) -> None:
        self.journal.close()
        self.ledger.close()
