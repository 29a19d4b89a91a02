"""Lines are chosen by how they begin; only what is shown is parsed."""

from datetime import UTC, datetime
from math import inf
from pathlib import Path

import pytest

from fieldnav.inquiry.choice import Choice, Chosen, Only
from fieldnav.inquiry.lines import JournalLines
from fieldnav.journal.entry import Entry, Line
from fieldnav.journal.journal import Journal, read

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
TRACKING, COASTING, EXIT = "Forward.Follow.Tracking", "Forward.Follow.Coasting", "Forward.Exit"
ENTRIES = [
    Entry(1.0, "rows lost", TRACKING, COASTING, 1),
    Entry(2.0, "rows found", COASTING, TRACKING, 1),
    Entry(3.0, "held by the gate", TRACKING, TRACKING, 1),
    Entry(4.0, "lane ended", TRACKING, EXIT, 1),
    Entry(5.0, "pause", EXIT, "Paused", 2),
    Entry(6.0, "resume", "Paused", EXIT, None),
    Entry(7.0, "fail", EXIT, "Fault.Recoverable", 2),
    Entry(8.0, "disk full", "Fault.Recoverable", "Fault.Recoverable", 2),
]


@pytest.fixture
def journal(tmp_path: Path) -> Path:
    with Journal(tmp_path / "journal.jsonl", START) as journal:
        for entry in ENTRIES:
            journal.record(entry)
    return tmp_path / "journal.jsonl"


def chosen(path: Path, choice: Choice, most: int | None = None) -> tuple[list[Line], int]:
    with JournalLines(path) as lines:
        return Chosen(lines, choice).newest(most)


@pytest.mark.parametrize(
    ("choice", "stamps_s"),
    [
        (Choice(), [1, 2, 3, 4, 5, 6, 7, 8]),
        (Choice(state="coasting"), [1, 2]),
        (Choice(state="Follow.Tracking"), [1, 2, 3, 4]),
        (Choice(state="Track"), []),
        (Choice(event="ROWS"), [1, 2]),
        (Choice(lane=2), [5, 7, 8]),
        (Choice(lane=1, event="lost"), [1]),
        (Choice(from_s=3.0, to_s=5.0), [3, 4, 5]),
        (Choice(from_s=8.5, to_s=inf), []),
        (Choice(only=Only.STOPS), [5, 7, 8]),
        (Choice(only=Only.CHANGES), [1, 2, 4, 5, 6, 7]),
    ],
)
def test_a_choice_gives_the_lines_of_which_all_is_true(
    journal: Path, choice: Choice, stamps_s: list[float]
) -> None:
    lines, more = chosen(journal, choice)

    assert [line.stamp_s for line in lines] == stamps_s
    assert more == 0


def test_of_too_many_the_newest_are_given_and_the_others_counted(journal: Path) -> None:
    lines, more = chosen(journal, Choice(state="Exit"), most=2)

    assert [line.stamp_s for line in lines] == [6, 7]
    assert more == 2


def test_only_what_is_given_is_parsed(journal: Path) -> None:
    with JournalLines(journal) as lines:
        before = lines.parsed

        Chosen(lines, Choice(from_s=1.5)).newest(1)

        assert lines.parsed - before == 1


def test_lines_that_begin_otherwise_are_chosen_all_the_same(journal: Path) -> None:
    expected = chosen(journal, Choice(state="Coasting", lane=1))
    journal.write_text(journal.read_text().replace('{"seq"', '{ "seq"'))

    assert chosen(journal, Choice(state="Coasting", lane=1)) == expected
    assert len(read(journal)) == len(ENTRIES)
