"""`fieldnav log list`: the runs there are, whatever their state."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from fieldnav.cli.app import run
from fieldnav.journal.ledger import Booking, Ledger

from .made import a_run

Printed = Callable[[], str]


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


def test_no_runs_is_said_and_is_no_error(runs: Path, printed: Printed) -> None:
    assert run(["log", "list"]) == 0

    assert printed() == "no runs in runs; make one with: fieldnav simulate demo\n"


def test_a_folder_of_runs_elsewhere_is_read(tmp_path: Path, printed: Printed) -> None:
    a_run(tmp_path / "elsewhere", "demo", completed=True)

    assert run(["log", "list", "--runs", str(tmp_path / "elsewhere")]) == 0

    assert "finished" in printed()


def test_of_a_run_that_broke_off_the_ledger_knows_lanes_and_time(runs: Path, printed: Printed) -> None:
    directory = a_run(runs, "demo", completed=None)
    with Ledger(directory.ledger) as ledger:
        ledger.book(
            Booking(
                stamp_s=101.5,
                state="x",
                side="right",
                lanes=3,
                lane=2,
                done=(1,),
                rows=3,
                forward_m=1.0,
                sideways_m=0.0,
            )
        )

    assert run(["log", "list"]) == 0

    assert printed().splitlines()[-1].split()[1:5] == ["broken", "off", "1/3", "1:41.5"]
