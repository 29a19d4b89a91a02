"""Whatever is broken or missing in a run's directory, there is a report, and it says so."""

from collections.abc import Callable
from pathlib import Path

import pytest

from fieldnav.errors import OutputError
from fieldnav.journal.directory import RunDirectory
from fieldnav.report.writing import write_report

from .conftest import RunMaker
from .made_run import STORY
from .shown_page import page_of


def cut_the_journal(directory: RunDirectory) -> None:
    content = directory.journal.read_bytes()
    directory.journal.write_bytes(content[: len(content) // 2])


def spoil_the_journal(directory: RunDirectory) -> None:
    directory.journal.write_bytes(b"\x00\xff not a journal\n" + directory.journal.read_bytes())


def spoil_the_recording(directory: RunDirectory) -> None:
    directory.recording.write_bytes(b"no MCAP at all" * 100)


def cut_the_recording(directory: RunDirectory) -> None:
    content = directory.recording.read_bytes()
    directory.recording.write_bytes(content[: len(content) // 3])


def spoil_the_rest(directory: RunDirectory) -> None:
    for path in (directory.summary, directory.settings, directory.ledger, directory.map):
        path.write_bytes(b"\xff\x00{not: [what it should be\n")


def remove_the_rest(directory: RunDirectory) -> None:
    for path in (directory.summary, directory.settings, directory.ledger):
        path.unlink()


@pytest.mark.parametrize(
    ("damage", "said"),
    [
        (cut_the_journal, ""),
        (spoil_the_journal, "line 1 is not a line of a journal"),
        (spoil_the_recording, "recording.mcap"),
        (cut_the_recording, ""),
        (spoil_the_rest, "is not the summary of a run"),
        (remove_the_rest, "There are no settings to be read."),
    ],
)
def test_whatever_is_broken_there_is_a_report_that_says_so(
    make_run: RunMaker, damage: Callable[[RunDirectory], None], said: str
) -> None:
    directory = make_run(recorded=True)
    damage(directory)

    page = page_of(directory)

    assert said in page.text("missing")
    assert page.text("outcome")
    assert not page.stray


def test_an_empty_journal_has_a_report(make_run: RunMaker) -> None:
    directory = make_run(STORY[:1], completed=None)
    directory.journal.write_bytes(b"")

    page = page_of(directory)

    assert "no journal lines" in page.text("outcome")


def test_a_report_that_cannot_be_written_is_one_clear_line(make_run: RunMaker, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written"):
        write_report(make_run(), tmp_path / "no" / "folder" / "report.html")
