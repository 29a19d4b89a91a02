"""A journal followed while a run is driven, broken off, resumed, and at its end."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from datetime import UTC, datetime

from fieldnav.inquiry.following import follow
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.journal.ledger import Ledger

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
Written = Callable[..., RunDirectory]


class Driven:
    """A run in whose waits one thing after the other happens."""

    def __init__(self, directory: RunDirectory) -> None:
        self.directory, self.told = directory, 0
        self.happens: list[Callable[[], object]] = []
        self._held = ExitStack()

    def begin(self) -> None:
        self._held.enter_context(Ledger(self.directory.ledger))

    def end(self) -> None:
        self._held.close()

    def write(self, *entries: Entry) -> None:
        with Journal(self.directory.journal, START) as journal:
            for entry in entries:
                journal.record(entry)

    def begin_and_write(self, *entries: Entry) -> None:
        self.begin()
        self.write(*entries)

    def write_and_end(self, *entries: Entry) -> None:
        self.write(*entries)
        self.end()

    def tear_and_end(self) -> None:
        """Power fails within a line."""
        with self.directory.journal.open("ab") as file:
            file.write(b'{"seq": 9, "stamp')
        self.end()

    def followed(self, most: int = 2) -> list[int]:
        lines = follow(self.directory, most, self._wait, self._waiting)
        return [line.seq for line in lines]

    def _wait(self) -> None:
        self.happens.pop(0)()

    def _waiting(self) -> None:
        self.told += 1


def test_of_a_run_that_nobody_drives_the_last_lines_are_all_there_is(written: Written) -> None:
    assert Driven(written()).followed() == [5, 6]


def test_each_line_of_a_running_mission_comes_once_until_its_end(
    written: Written, mission: Sequence[Entry]
) -> None:
    run = Driven(written(mission[:3]))
    run.begin()
    run.happens = [lambda: run.write(mission[3]), lambda: None, lambda: run.write_and_end(*mission[4:])]

    assert run.followed() == [1, 2, 3, 4, 5, 6]
    assert (run.happens, run.told) == ([], 0)


def test_a_run_that_broke_off_is_waited_for_and_followed_on_when_it_is_resumed(
    written: Written, mission: Sequence[Entry]
) -> None:
    run = Driven(written(mission[:3]))
    run.begin()
    run.happens = [
        run.tear_and_end,
        lambda: None,
        lambda: run.begin_and_write(mission[3]),
        lambda: run.write_and_end(*mission[4:]),
    ]

    assert run.followed() == [1, 2, 3, 4, 5, 6]
    assert (run.happens, run.told) == ([], 1)
