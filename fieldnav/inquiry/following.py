"""A journal followed while it is written."""

from collections.abc import Callable, Iterator
from pathlib import Path

from fieldnav.inquiry.choice import Choice, Chosen
from fieldnav.inquiry.lines import JournalLines
from fieldnav.inquiry.stops import stands
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Line
from fieldnav.journal.ledger_lock import being_driven


class Following:
    """Gives what has been written since the last look; `newest` is the last line there was."""

    def __init__(self, path: Path, most: int) -> None:
        """The first look gives so many of the last lines. Raises FieldnavError."""
        self._path, self._most = path, most
        self._end: int | None = None
        self.newest: Line | None = None

    def look(self) -> list[Line]:
        """The new lines, in order. Raises FieldnavError."""
        with JournalLines(self._path) as journal:
            if self._end is None:
                found, _ = Chosen(journal, Choice()).newest(self._most)
            else:
                found = [journal.parse(placed) for placed in journal.forwards(self._end)]
            self._end, self.newest = journal.end, journal.last
        return found


def follow(
    directory: RunDirectory, most: int, wait: Callable[[], None], waiting: Callable[[], None]
) -> Iterator[Line]:
    """The last lines, then each as it is written, until nobody drives the run any more.

    wait: until it is worth another look; waiting: told once where a run that was driven broke off: that is no
    end, it may be resumed. Raises FieldnavError.
    """
    following = Following(directory.journal, most)
    was_driven = told = False
    while True:
        driven = being_driven(directory.ledger)  # asked first: what is written until its end is still seen
        yield from following.look()
        newest = following.newest
        if not driven and (not was_driven or (newest is not None and stands(newest))):
            return
        if not driven and not told:
            waiting()
        told = not driven
        was_driven = True
        wait()
