"""`fieldnav log` tells a person in the field what happened and why."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

import pytest
from rich.text import Text

from fieldnav.cli.app import run
from fieldnav.cli.log.tables import transitions_table
from fieldnav.inquiry.words import decisive, judgement
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry, Judged, Line
from fieldnav.journal.journal import Journal
from fieldnav.journal.summary import Lanes, Summary, Switches, write_summary
from fieldnav.messages import Evidence

Printed = Callable[[], str]
START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Printed:
    return lambda: capsys.readouterr().out


@pytest.fixture
def runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path / "runs"


def a_run(runs: Path, name: str, completed: bool | None, hour: int = 8) -> RunDirectory:
    """A run whose last entry is a fault; without a summary when `completed` is None."""
    start = START.replace(hour=hour)
    directory = RunDirectory.create(runs, name, start)
    seen = (Evidence("no plant in the top half", 0.53, 0.4, "s"), Evidence("plants", 41))
    with Journal(directory.journal, start) as journal:
        journal.record(Entry(0.4, "ready", "Checking", "Forward.Follow.Acquiring", 1, 0))
        journal.record(Entry(85.43, "lane ended", "Forward.Follow.Tracking", "Forward.Exit", 1, 3, seen))
        journal.record(
            Entry(90.0, "fail", "Forward.Exit", "Fault.Recoverable", 1, 0, reason="rear camera silent")
        )
    if completed is not None:
        figures = Summary(
            completed=completed,
            lanes=Lanes(done=1, total=3),
            distance_m=12.6,
            duration_s=90.0,
            wall_s=20.0,
            realtime_factor=4.5,
            transitions=3,
            faults=1,
            switches=Switches(attempted=0, succeeded=0),
        )
        write_summary(directory.summary, figures)
    return directory


def test_a_transition_is_told_with_the_figure_that_decided_it(runs: Path, printed: Printed) -> None:
    a_run(runs, "demo", completed=False)

    assert run(["log", "show", "last"]) == 0

    line = next(line for line in printed().splitlines() if "lane ended" in line)
    assert line.split()[:4] == ["1", "1:25.4", "Forward.Follow.Tracking", "Forward.Exit"]
    assert "no plant in the top half 0.53 > 0.4 s" in line
    assert "plants 41" not in line


def test_a_stopped_run_says_where_and_why_at_its_head(runs: Path, printed: Printed) -> None:
    a_run(runs, "demo", completed=False)

    assert run(["log", "show"]) == 0

    first, second = printed().splitlines()[:2]
    assert first == "20260501T083000Z-demo  stopped  lanes 1/3, switches 0/0, 12.6 m in 1:30.0"
    assert second == "Fault.Recoverable: rear camera silent"


def test_runs_are_listed_newest_first_with_their_outcome(runs: Path, printed: Printed) -> None:
    a_run(runs, "demo", completed=True, hour=8)
    a_run(runs, "beans", completed=False, hour=9)
    a_run(runs, "potato", completed=None, hour=10)
    torn = a_run(runs, "maize", completed=True, hour=11)
    torn.summary.write_text("{}")

    assert run(["log", "list"]) == 0

    lines = printed().splitlines()[2:]
    for line, name, outcome in zip(
        lines,
        ("maize", "potato", "beans", "demo"),
        ("unreadable", "broken off", "stopped", "finished"),
        strict=True,
    ):
        assert name in line
        assert outcome in line


def test_both_commands_print_json_for_programs(runs: Path, printed: Printed) -> None:
    directory = a_run(runs, "demo", completed=False)

    assert run(["log", "list", "--json"]) == 0
    (listed,) = json.loads(printed())
    assert (listed["run"], listed["outcome"], listed["summary"]["lanes"]["done"]) == (
        directory.path.name,
        "stopped",
        1,
    )

    assert run(["log", "show", "demo", "--json"]) == 0
    shown = json.loads(printed())
    assert [line["event"] for line in shown] == ["ready", "lane ended", "fail"]
    assert shown[1]["evidence"][0]["threshold"] == 0.4


def test_what_looks_like_markup_is_shown_as_it_is(runs: Path, printed: Printed) -> None:
    folder = runs / "[" / "a]"
    journal = a_run(folder, "demo", completed=False).journal
    journal.write_text(journal.read_text().replace("rear camera silent", "[/x] [red]silent[/red]"))
    journal.parent.rename(folder / "[bold]run")

    assert run(["log", "list", "--runs", str(folder)]) == 0
    listed = printed()
    assert "runs in " in listed and "/[/a]" in listed
    assert "[bold]run" in listed and "Fault.Recoverable: [/x] [red]silent[/red]" in listed

    assert run(["log", "show", "--runs", str(folder)]) == 0
    shown = printed()
    assert shown.startswith("[bold]run ") and shown.count("[/x] [red]silent[/red]") == 2


def test_the_reason_stands_before_the_evidence_and_stands_out() -> None:
    held = Judged(name="coasted", value=2.1, threshold=2.0, unit="m")
    line = Line(
        seq=0, stamp_s=1, utc=START, event="fail", source="A", target="B", evidence=(held,), reason="lost"
    )

    (because,) = transitions_table([line]).columns[-1].cells

    assert isinstance(because, Text)
    assert because.plain == "lost\ncoasted 2.1 > 2 m"
    assert [(span.start, span.end, span.style) for span in because.spans] == [(0, len("lost"), "bold")]


@pytest.mark.parametrize("number", ["1e400", "-1e400"])
def test_a_journal_with_a_number_beyond_all_numbers_is_one_line(
    number: str, runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    journal = a_run(runs, "demo", completed=False).journal
    journal.write_text(journal.read_text().replace("85.43", number))

    assert run(["log", "show"]) == 2
    assert "journal.jsonl: line 2 is not a line of a journal" in capsys.readouterr().err


def test_the_list_asks_no_more_of_a_journal_than_its_last_line(runs: Path, printed: Printed) -> None:
    journal = a_run(runs, "demo", completed=False).journal
    journal.write_bytes(b"garbage\n" + journal.read_bytes())
    torn = a_run(runs, "torn", completed=False, hour=9).journal
    torn.write_bytes(torn.read_bytes() + b"garbage\ngarbage\n")

    assert run(["log", "list"]) == 0

    worse, better = printed().splitlines()[2:]
    assert "unreadable" in worse and "journal.jsonl: line 4 is not a line of a journal" in worse
    assert "stopped" in better and "Fault.Recoverable: rear camera silent" in better


def test_a_summary_with_a_number_beyond_all_numbers_is_shown(runs: Path, printed: Printed) -> None:
    summary = a_run(runs, "demo", completed=True).summary
    summary.write_text(summary.read_text().replace('"duration_s": 90.0', '"duration_s": 1e400'))

    assert run(["log", "list"]) == 0
    assert "unknown" in printed()


def test_a_file_in_place_of_the_folder_of_runs_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()

    assert run(["log", "list", "--runs", str(tmp_path / "file")]) == 2

    captured = capsys.readouterr()
    assert captured.out == "" and "Not a directory; allowed is a folder that holds runs" in captured.err


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a device that is always full")
def test_a_full_disk_behind_standard_output_is_one_line(runs: Path) -> None:
    a_run(runs, "demo", completed=True)
    command = [sys.executable, "-m", "fieldnav", "log", "list", "--runs", str(runs)]

    with Path("/dev/full").open("w") as full:
        ended = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)

    assert ended.returncode == 2
    assert ended.stderr == "error: standard output: cannot be written: No space left on device\n"


def test_a_name_that_the_terminal_cannot_show_is_shown_in_escapes(runs: Path) -> None:
    a_run(runs, "demo", completed=True).path.rename(runs / os.fsdecode(b"\xff"))
    command = [sys.executable, "-m", "fieldnav", "log", "list", "--runs", str(runs)]

    ended = subprocess.run(command, capture_output=True, text=True, check=False)

    assert (ended.returncode, ended.stderr) == (0, "") and "\\udcff" in ended.stdout


def test_no_runs_is_said_and_is_no_error(runs: Path, printed: Printed) -> None:
    assert run(["log", "list"]) == 0

    assert printed() == "no runs in runs; make one with: fieldnav simulate demo\n"


def test_a_folder_of_runs_elsewhere_is_read(tmp_path: Path, printed: Printed) -> None:
    a_run(tmp_path / "elsewhere", "demo", completed=True)

    assert run(["log", "list", "--runs", str(tmp_path / "elsewhere")]) == 0

    assert "finished" in printed()


@pytest.mark.parametrize(
    ("judged", "words"),
    [
        (Judged(name="frame age", value=0.61, threshold=0.5, unit="s"), "frame age 0.61 > 0.5 s"),
        (Judged(name="rows", value=3, threshold=3), "rows 3 = 3"),
        (Judged(name="offset", value=-0.0321, threshold=0.05, unit="m"), "offset -0.0321 < 0.05 m"),
        (Judged(name="plants", value=None), "plants unknown"),
        (Judged(name="crossed", value=12345.6, unit="px"), "crossed 12346 px"),
    ],
)
def test_a_judged_quantity_reads_as_a_comparison(judged: Judged, words: str) -> None:
    assert judgement(judged) == words


def test_quantities_without_threshold_are_told_when_there_is_nothing_better() -> None:
    plain, held = Judged(name="a", value=1), Judged(name="b", value=1, threshold=2)

    assert decisive([plain, held]) == [held]
    assert decisive([plain]) == [plain]
