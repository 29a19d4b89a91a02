"""`fieldnav diagram` prints what the state machine's package draws."""

import re
from datetime import UTC, datetime
from pathlib import Path
from xml.etree import ElementTree

import pytest

from fieldnav.cli.app import run
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from states.diagram import mermaid, svg
from states.drawing.paint import TIMES


def test_mermaid_is_printed_unless_told_otherwise(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram"]) == 0
    assert capsys.readouterr().out == mermaid() + "\n"


def test_the_picture_is_printed_when_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram", "--format", "svg"]) == 0
    assert capsys.readouterr().out == svg() + "\n"


def test_an_unknown_format_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram", "--format", "png"]) == 2
    assert "'png' is not one of 'mermaid', 'svg'" in capsys.readouterr().err


@pytest.fixture
def runs(tmp_path: Path) -> Path:
    """A folder with one run, which was stopped by a person in its first lane."""
    folder = tmp_path / "20260501T083000Z-demo"
    folder.mkdir()
    lane = "Forward.Follow"
    with Journal(folder / "journal.jsonl", datetime(2026, 5, 1, 8, 30, tzinfo=UTC)) as journal:
        for entry in (
            Entry(0.0, "start", "Idle", "Checking"),
            Entry(2.0, "ready", "Checking", f"{lane}.Acquiring"),
            Entry(3.0, "rows found", f"{lane}.Acquiring", f"{lane}.Tracking"),
            Entry(63.0, "rows vanished", f"{lane}.Tracking", f"{lane}.Hoping"),
            Entry(93.0, "fail", f"{lane}.Hoping", "Fault.Recoverable", reason="stopped by the operator"),
        ):
            journal.record(entry)
    return tmp_path


def test_a_run_is_painted_in(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram", "--run", "last", "--runs", str(runs)]) == 0

    picture = ElementTree.fromstring(capsys.readouterr().out)
    told = [each.text for each in picture.iter() if each.text]
    assert "20260501T083000Z-demo" in told
    assert "stopped by the operator" in told
    assert f"1:00 · 1{TIMES}" in told, "tracking, for a minute"
    assert f"rows found {TIMES}1" in told
    (outcome,) = [words for words in told if "in all" in words]
    assert outcome.startswith("broken off · 1:03 in all"), "no summary was written"
    assert outcome.endswith("this version does not have: 2"), "no such state, no such event"


def test_the_picture_goes_into_a_file_when_one_is_named(
    runs: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "painted.svg"

    assert run(["diagram", "--run", "demo", "--runs", str(runs), "--format", "svg", "--out", str(file)]) == 0

    assert capsys.readouterr().out == ""
    assert ElementTree.parse(file).getroot().tag.endswith("svg")


def test_a_file_that_cannot_be_written_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["diagram", "--out", str(tmp_path / "lacks" / "x.md")]) == 2

    said = capsys.readouterr()
    assert said.out == ""
    assert re.fullmatch(r"error: --out: \S+ cannot be written: No such file .*; allowed is .*\n", said.err)


def test_a_run_is_not_painted_into_mermaid_text(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram", "--run", "last", "--runs", str(runs), "--format", "mermaid"]) == 2

    assert capsys.readouterr().err == (
        "error: --format: 'mermaid' cannot have a run painted in; allowed with --run is svg\n"
    )


def test_a_run_that_is_not_there_is_named(runs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram", "--run", "yesterday", "--runs", str(runs)]) == 2

    assert "no run 'yesterday'" in capsys.readouterr().err
