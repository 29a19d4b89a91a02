"""`fieldnav log show`: some of the lines, as a table or a tree, wide or narrow."""

import io
import json
from collections.abc import Callable
from pathlib import Path

import pytest
from rich.console import Console

from fieldnav.cli.app import run
from fieldnav.cli.log.tables import runs_table, transitions_table
from fieldnav.inquiry.outcome import overview
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import read

from .made import COASTING, TRACKING, journalled

LOST = 210
Printed = Callable[[], str]


@pytest.fixture
def directory(runs: Path, monkeypatch: pytest.MonkeyPatch) -> RunDirectory:
    """A run in whose second lane the rows are lost and found again and again."""
    monkeypatch.setattr("os.fsync", lambda _: None)  # hundreds of lines need not be on the disk
    entries = [Entry(0.5, "ready", "Checking", "Forward.Follow.Acquiring", 1, 0)]
    for turn in range(LOST):
        entries.append(Entry(10 + turn, "rows lost", TRACKING, COASTING, 2, 3))
        entries.append(Entry(10.5 + turn, "rows found", COASTING, TRACKING, 2, 3))
    entries.append(Entry(300.0, "pause", TRACKING, "Paused", 2, 3, reason="paused by bob"))
    return journalled(runs, "demo", entries)


def shown(printed: Printed, *options: str) -> list[dict[str, object]]:
    assert run(["log", "show", *options, "--json"]) == 0
    found: list[dict[str, object]] = json.loads(printed())
    return found


@pytest.mark.usefixtures("directory")
def test_a_person_sees_the_newest_lines_and_how_many_there_are_besides(printed: Printed) -> None:
    assert run(["log", "show"]) == 0

    lines = printed().splitlines()
    assert "222 older lines are not shown; --all shows them" in lines
    assert sum("rows lost" in line or "rows found" in line for line in lines) == 199
    assert lines[-1].split()[:2] == ["421", "5:00.0"]


@pytest.mark.usefixtures("directory")
def test_all_of_them_are_shown_to_who_asks_for_all_and_to_programs(printed: Printed) -> None:
    assert run(["log", "show", "--all"]) == 0
    assert sum("rows lost" in line for line in printed().splitlines()) == LOST

    assert len(shown(printed)) == 2 * LOST + 2


@pytest.mark.usefixtures("directory")
@pytest.mark.parametrize(
    ("options", "seqs"),
    [
        (["--state", "acquiring"], [0]),
        (["--event", "pause"], [421]),
        (["--lane", "1"], [0]),
        (["--from", "3:38.4", "--to", "219.1"], [418, 419]),
        (["--stops"], [421]),
        (["--last", "2"], [420, 421]),
        (["--last", "1", "--event", "lost"], [419]),
        (["--state", "Paused", "--lane", "1"], []),
    ],
)
def test_options_choose_lines(options: list[str], seqs: list[int], printed: Printed) -> None:
    assert [line["seq"] for line in shown(printed, *options)] == seqs


@pytest.mark.usefixtures("directory")
def test_nothing_that_fits_is_said_and_is_no_error(printed: Printed) -> None:
    assert run(["log", "show", "--event", "lane ended"]) == 0

    assert printed().splitlines()[-1] == "no line of the journal is so"


@pytest.mark.usefixtures("directory")
@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--state", "Follow.Trackin"], "--state: 'Follow.Trackin': 'Trackin' is no state; allowed are "),
        (["--from", "early"], "--from: 'early': allowed is a time of the run such as 41.3 or 1:23.4"),
    ],
)
def test_what_no_line_can_be_chosen_by_is_one_line(
    options: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["log", "show", *options]) == 2

    captured = capsys.readouterr()
    assert captured.out == "" and said in captured.err


@pytest.mark.usefixtures("directory")
def test_a_tree_has_the_transitions_under_lane_and_phase(printed: Printed) -> None:
    assert run(["log", "show", "--tree", "--last", "3"]) == 0

    _, _, _, lane, phase, lost, found, paused = (line.strip() for line in printed().splitlines())
    assert (lane, phase) == ("lane 2", "└── Forward.Follow  3:39.0")
    assert lost.endswith("3:39.0 rows lost -> Coasting")
    assert found.endswith("3:39.5 rows found -> Tracking")
    assert paused.endswith("5:00.0 pause -> Paused  paused by bob")


@pytest.mark.parametrize("width", [60, 80, 200])
def test_no_word_is_lost_and_none_is_torn_on_a_narrow_terminal(width: int, directory: RunDirectory) -> None:
    console = Console(width=width, file=io.StringIO(), record=True)
    console.print(transitions_table(read(directory.journal)[-1:], width))
    console.print(runs_table("runs", [overview(directory)], width))

    words = console.export_text().split()
    for word in (directory.path.name, TRACKING, "Paused", "5:00.0", "pause", "broken", "off", "bob"):
        assert any(word in each for each in words), word
