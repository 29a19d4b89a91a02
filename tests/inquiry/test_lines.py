"""A journal is read in places, and the same comes of it as of reading it whole."""

import json
from datetime import UTC, datetime
from itertools import islice
from pathlib import Path
from random import Random

import pytest

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.lines import STRETCH_BYTES, JournalLines
from fieldnav.journal.entry import Entry, line_of
from fieldnav.journal.journal import read
from fieldnav.messages import Evidence

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
LINES = 3000
SOME_LINES = 40
"""Of parsing, of a journal of thousands: what halving it takes."""


def content(lines: int) -> bytes:
    """Lines of unequal length, two a second; a stretch of the reader ends within one of them."""
    texts = []
    for number in range(lines):
        evidence = tuple(Evidence(f"quantity {each}", number, 1.0) for each in range(number % 13))
        line = line_of(Entry(number / 2, "e", "s", "t", number // 100, evidence=evidence), number, START)
        texts.append(json.dumps(line).encode() + b"\n")
    return b"".join(texts)


@pytest.fixture(scope="module")
def journal(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("run") / "journal.jsonl"
    path.write_bytes(content(LINES))
    assert path.stat().st_size > STRETCH_BYTES
    return path


def test_both_ways_through_give_every_line_once(journal: Path) -> None:
    texts = journal.read_bytes().split(b"\n")[:-1]

    with JournalLines(journal) as lines:
        assert [text for _, text in lines.forwards()] == texts
        assert [text for _, text in lines.backwards()] == texts[::-1]
        assert sorted(lines.backwards()) == list(lines.forwards())


def test_a_part_is_gone_through_from_line_start_to_line_start(journal: Path) -> None:
    with JournalLines(journal) as lines:
        placed = list(lines.forwards())
        begin, end = placed[70][0], placed[2900][0]

        assert list(lines.backwards(end, begin)) == placed[70:2900][::-1]
        assert list(lines.forwards(end)) == placed[2900:]
        assert list(lines.backwards(begin, begin)) == []


@pytest.mark.parametrize("number", [0, 1, 1234, LINES - 1])
def test_a_line_is_found_by_its_number_and_by_its_time(journal: Path, number: int) -> None:
    with JournalLines(journal) as lines:
        by_number = lines.find(lambda seq, _: seq >= number)
        by_time = lines.find(lambda _, stamp_s: stamp_s > number / 2 - 0.1)

        assert by_number == by_time
        assert lines.parse(next(lines.forwards(by_number))).seq == number


def test_what_is_past_every_line_is_the_end(journal: Path) -> None:
    with JournalLines(journal) as lines:
        assert lines.find(lambda seq, _: seq > LINES) == lines.end == journal.stat().st_size


def test_neither_the_last_line_nor_a_search_reads_the_whole_file(journal: Path) -> None:
    with JournalLines(journal) as lines:
        assert lines.last is not None and lines.last.seq == LINES - 1
        assert lines.bytes_read < journal.stat().st_size / 2
        before = lines.bytes_read

        lines.find(lambda seq, _: seq >= LINES // 3)

        assert lines.bytes_read - before < journal.stat().st_size / 2
        assert lines.parsed <= SOME_LINES


def test_lines_that_begin_otherwise_are_found_all_the_same(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    texts = [json.loads(text) for text in content(50).splitlines()]
    path.write_text("".join(json.dumps(dict(reversed(text.items()))) + "\n" for text in texts))

    with JournalLines(path) as lines:
        start = lines.find(lambda seq, _: seq >= 33)
        assert lines.parse(next(lines.forwards(start))).seq == 33


def test_a_journal_cut_anywhere_gives_what_reading_it_whole_gives(tmp_path: Path) -> None:
    path, random = tmp_path / "journal.jsonl", Random(1)
    whole = content(30)
    for cut in [0, 1, len(whole) - 1, *random.sample(range(len(whole)), 60)]:
        path.write_bytes(whole[:cut])
        expected = read(path)

        with JournalLines(path) as lines:
            assert [lines.parse(each) for each in lines.forwards()] == expected, f"cut at {cut}"
            assert lines.last == (expected[-1] if expected else None), f"cut at {cut}"


def test_a_last_line_that_is_none_counts_as_torn(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    path.write_bytes(content(3) + b"\0\0\0\n")

    with JournalLines(path) as lines:
        assert [lines.parse(each).seq for each in lines.forwards()] == [0, 1, 2]
        assert read(path)[-1] == lines.last


def test_a_wrong_line_is_named_by_its_number(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    first, second, third = content(3).splitlines(keepends=True)
    path.write_bytes(first + b"garbage\n" + second + third)

    with JournalLines(path) as lines, pytest.raises(FieldnavError, match="line 2 is not a line of a journal"):
        lines.parse(next(islice(lines.forwards(), 1, None)))


def test_a_journal_that_is_not_there_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(FieldnavError, match="cannot be read: No such file or directory"):
        JournalLines(tmp_path / "journal.jsonl")
