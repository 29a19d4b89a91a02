"""A run whose files say what cannot be is not taken up: one line names file, key and what is allowed."""

import json
import os
from datetime import UTC, datetime
from pathlib import Path

import pytest

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.resolved import write_settings
from fieldnav.settings.loading import load_crop, load_robot

STARTED = datetime(2026, 5, 1, tzinfo=UTC)
LEDGER = {
    "stamp_s": 5.0,
    "state": "Backward.Sidestep.Crossing",
    "side": "right",
    "lanes": 4,
    "lane": 2,
    "done": [1, 2],
    "rows": 3,
    "forward_m": 1.5,
    "sideways_m": -0.4,
    "sidestep_from_m": 0.1,
}
JOURNAL = {
    "seq": 0,
    "stamp_s": 4.0,
    "utc": "2026-05-01T00:00:04.000Z",
    "event": "rows found",
    "source": "Forward.Follow.Acquiring",
    "target": "Forward.Follow.Tracking",
}


@pytest.fixture
def directory(tmp_path: Path) -> RunDirectory:
    """A run as a crash leaves it between two lanes."""
    made = RunDirectory.create(tmp_path / "runs", "bonnbot", STARTED)
    write_settings(made.settings, load_crop("sugar-beet"), load_robot("bonnbot"))
    made.journal.write_text(json.dumps(JOURNAL) + "\n")
    made.ledger.write_text(json.dumps(LEDGER) + "\n")
    return made


def refusal(directory: RunDirectory, capsys: pytest.CaptureFixture[str]) -> str:
    before = {path: path.lstat().st_mtime_ns for path in directory.path.iterdir()}

    status = run(["run", "--out", str(directory.path.parent), "--resume", "last", "--robot", "./none.yaml"])

    said = capsys.readouterr().err
    assert (status, said.count("\n")) == (2, 1)
    assert {path: path.lstat().st_mtime_ns for path in directory.path.iterdir()} == before
    return said.removeprefix("error: ").strip()


def test_a_ledger_that_says_what_can_be_is_taken_up(directory, capsys) -> None:
    assert (
        refusal(directory, capsys) == "./none.yaml: there is no such file"
    )  # all else has been read by then


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"side": "both"}, "side: 'both' is not allowed; allowed is right or left"),
        ({"lane": 0}, "lane: 0 is not allowed; allowed is a whole number from 1 to 1000"),
        ({"lane": -1}, "lane: -1 is not allowed"),
        ({"lane": 2**70}, "lane: 1180591620717411303424 is not allowed"),
        ({"lane": 99}, "lane: 99 is not allowed; allowed is a lane from 1 to 4"),
        ({"lane": "2"}, "lane: '2' is not allowed; allowed is a whole number"),
        ({"lane": 2.0}, "lane: 2.0 is not allowed"),
        ({"lane": True}, "lane: true is not allowed"),
        ({"lanes": 2}, "state: a sidestep is not allowed in lane 2, the last of 2"),
        ({"lanes": 10**9}, "lanes: 1000000000 is not allowed"),
        ({"rows": -3}, "rows: -3 is not allowed; allowed is a whole number from 0 to 1000"),
        ({"done": [1]}, "done: [1] is not allowed in lane 2; allowed is [1, 2]"),
        ({"done": [2, 1]}, "done: [2, 1] is not allowed"),
        ({"done": [1, 1, 2]}, "done: [1, 1, 2] is not allowed"),
        ({"done": [1, 2, 3]}, "done: [1, 2, 3] is not allowed"),
        ({"done": [-1]}, "done.0: -1 is not allowed"),
        ({"done": 2}, "done: 2 is not allowed"),
        ({"state": "Forward.Sidestep.Crossing"}, "state: 'Forward' is not allowed in lane 2"),
        ({"state": "Backward.Follow.Tracking"}, "done: [1, 2] is not allowed in lane 2; allowed is [1]"),
        ({"state": "Checking"}, "state: 'Checking' is none of a lane's"),
        ({"stamp_s": 1e15}, "stamp_s: 1000000000000000.0 is not allowed"),
        ({"stamp_s": -1}, "stamp_s: -1 is not allowed"),
        ({"forward_m": 1e300}, "forward_m: 1e+300 is not allowed"),
        ({"sidestep_from_m": 400.0}, "sidestep_from_m: 400 is not allowed; allowed is at most 10"),
        ({"speed": 2}, "speed: 2: there is no such key"),
        ({"finished": "no"}, "finished: 'no' is not allowed; allowed is true or false"),
    ],
)  # fmt: skip
def test_a_ledger_that_says_what_cannot_be_is_refused(changes, said, directory, capsys) -> None:
    directory.ledger.write_text(json.dumps(LEDGER | changes) + "\n")

    line = refusal(directory, capsys)

    assert line.startswith(f"{directory.ledger}: its last line") and said in line


def test_a_key_of_the_ledger_given_twice_is_refused(directory, capsys) -> None:
    directory.ledger.write_text(json.dumps(LEDGER)[:-1] + ', "lane": 3}\n')

    assert refusal(directory, capsys).endswith("lane: is given twice; allowed is once")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"utc": "0001-01-01T00:00:00Z"}, "utc: '0001-01-01T00:00:00Z': allowed is a time from 1970 to 2200"),
        ({"utc": "9999-12-31T23:59:59Z"}, "utc: '9999-12-31T23:59:59Z': allowed is a time from 1970 to 2200"),
        ({"utc": "2026-05-01T00:00:00"}, "utc: '2026-05-01T00:00:00': allowed is a time with its zone"),
        ({"utc": "noon"}, "utc: 'noon' is not allowed; allowed is a time with its zone"),
        ({"utc": 5}, "utc: 5 is not allowed"),
        ({"stamp_s": 1e15}, "stamp_s: 1000000000000000.0 is not allowed"),
        ({"seq": -1}, "seq: -1 is not allowed"),
        ({"lane": 2**70}, "lane: 1180591620717411303424 is not allowed"),
        ({"rows": -3}, "rows: -3 is not allowed"),
    ],
)  # fmt: skip
def test_a_journal_that_says_what_cannot_be_is_refused(changes, said, directory, capsys) -> None:
    lines = [json.dumps(JOURNAL | changes), json.dumps(JOURNAL | {"seq": 1})]
    directory.journal.write_text("\n".join(lines) + "\n")

    line = refusal(directory, capsys)

    assert line.startswith(f"{directory.journal}: line 1 is not a line of a journal: ") and said in line


@pytest.mark.parametrize("name", ["ledger.jsonl", "settings.yaml", "can.log", ".journal.jsonl.reserve"])
@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_a_pipe_or_a_device_among_a_runs_files_is_refused_and_not_waited_for(
    name, kind, directory, capsys
) -> None:
    path = directory.path / name
    path.unlink(missing_ok=True)
    if kind == "pipe":
        os.mkfifo(path)
    else:
        path.symlink_to("/dev/zero")

    assert refusal(directory, capsys) == f"{path}: is a pipe or a device; allowed is a file"


@pytest.mark.parametrize("command", ["list", "show", "stats", "report", "why", "plot"])
def test_reading_a_run_whose_journal_and_ledger_are_pipes_does_not_wait(command, directory, capsys) -> None:
    for path in (directory.journal, directory.ledger, directory.summary):
        path.unlink(missing_ok=True)
        os.mkfifo(path)
    arguments = [] if command == "list" else [str(directory.path)]

    status = run(["log", command, *arguments, "--runs", str(directory.path.parent)])

    assert status in (0, 2)
    assert "Traceback" not in capsys.readouterr().err
