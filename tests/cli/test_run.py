"""`fieldnav run`: wrong input is one line, and nothing is driven where a check fails."""

import json
from datetime import UTC, datetime
from pathlib import Path

import pytest
import yaml

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.journal.ledger import Booking, Ledger
from fieldnav.journal.resolved import write_settings
from fieldnav.settings.loading import load_crop, load_robot

FILES = ("--robot", "bonnbot", "--crop", "sugar-beet")
STARTED = datetime(2026, 5, 1, tzinfo=UTC)


def said(capsys: pytest.CaptureFixture[str]) -> str:
    captured = capsys.readouterr()
    assert captured.err.count("\n") == 1, captured.err
    return captured.err


def broken_off_run(folder: Path, **changes: object) -> RunDirectory:
    """A run as a crash leaves it in the middle of a lane."""
    directory = RunDirectory.create(folder, "bonnbot", STARTED)
    write_settings(directory.settings, load_crop("sugar-beet"), load_robot("bonnbot"))
    with Journal(directory.journal, STARTED) as journal:
        journal.record(Entry(4.0, "rows found", "Forward.Follow.Acquiring", "Forward.Follow.Tracking"))
    with Ledger(directory.ledger) as ledger:
        booking = Booking(
            stamp_s=5.0,
            state="Forward.Follow.Tracking",
            side="right",
            lanes=2,
            lane=1,
            done=(),
            rows=3,
            forward_m=1.5,
            sideways_m=0.0,
        )
        ledger.book(booking.model_copy(update=changes))
    return directory


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ([], "--robot: is not given"),
        (["--robot", "bonnbot"], "--crop: is not given"),
        (["--robot", "bonnbott", "--crop", "sugar-beet"], "unknown robot 'bonnbott'"),
        (["--robot", "bonnbot", "--crop", "sugarbeet"], "unknown crop 'sugarbeet'"),
        ([*FILES, "--confirm", "swich"], "--confirm: 'swich': allowed are"),
        ([*FILES, "--lanes", "0"], "--lanes"),
        (["--resume", "last"], "holds no runs"),
    ],
)
def test_wrong_input_is_one_line_and_leaves_nothing(options, words, tmp_path: Path, capsys) -> None:
    assert run(["run", "--out", str(tmp_path / "runs"), *options]) == 2
    assert words in said(capsys)
    assert not (tmp_path / "runs").exists()


def test_nothing_is_driven_where_a_check_fails(tmp_path: Path, capsys) -> None:
    robot = load_robot("bonnbot").model_dump(mode="json")
    robot["can"] = {"interface": "virtual", "channel": f"nobody-{tmp_path.name}"}
    for camera in robot["cameras"].values():
        camera["source"] = str(tmp_path / "no-such-camera")
    (tmp_path / "robot.yaml").write_text(yaml.safe_dump(robot), encoding="utf-8")
    options = ["--robot", str(tmp_path / "robot.yaml"), "--crop", "sugar-beet"]

    assert run(["run", "--out", str(tmp_path / "runs"), *options, "--json"]) == 1

    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("error: nothing was driven: ")
    for words in ("front camera opens", "rear camera opens", "bus frames: none within"):
        assert words in captured.err
    assert not (tmp_path / "runs").exists()


def test_a_run_that_is_resumed_keeps_its_lanes_and_side(tmp_path: Path, capsys) -> None:
    broken_off_run(tmp_path)

    assert run(["run", "--out", str(tmp_path), "--resume", "last", "--lanes", "5"]) == 2
    assert "a run that is resumed keeps its own" in said(capsys)


def test_a_finished_run_is_not_driven_again(tmp_path: Path, capsys) -> None:
    broken_off_run(tmp_path, finished=True)

    assert run(["run", "--out", str(tmp_path), "--resume", "last"]) == 2
    assert "the run is finished; there is nothing to resume" in said(capsys)


def test_a_run_without_a_ledger_says_that_it_never_drove(tmp_path: Path, capsys) -> None:
    directory = broken_off_run(tmp_path)
    directory.ledger.unlink()

    assert run(["run", "--out", str(tmp_path), "--resume", "last"]) == 2
    assert "had not begun to drive" in said(capsys)


@pytest.mark.parametrize(
    ("file", "content", "words"),
    [
        ("ledger.jsonl", b"nonsense\n", "its last line is none of a ledger's"),
        ("ledger.jsonl", b'{"stamp_s": 1, "state": "../../etc"}\n', "its last line is none of a ledger's"),
        ("settings.yaml", b"crop: {}\n", "crop: "),
        ("settings.yaml", b"!!python/object/apply:os.system ['true']\n", "settings.yaml"),
        ("journal.jsonl", b"nonsense\nnonsense\n", "line 1 is not a line of a journal"),
    ],
)
def test_a_run_whose_files_are_spoilt_is_one_line(file, content, words, tmp_path: Path, capsys) -> None:
    directory = broken_off_run(tmp_path)
    (directory.path / file).write_bytes(content)

    assert run(["run", "--out", str(tmp_path), "--resume", "last"]) == 2
    assert words in said(capsys)


def test_a_place_of_no_lane_is_refused(tmp_path: Path, capsys) -> None:
    broken_off_run(tmp_path, state="Forward.Follow.Flying")

    assert run(["run", "--out", str(tmp_path), "--resume", "last"]) == 2
    assert "'Forward.Follow.Flying' is none of a lane's" in said(capsys)


def test_a_broken_off_run_is_never_listed_as_finished(tmp_path: Path, capsys) -> None:
    broken_off_run(tmp_path)

    assert run(["log", "list", "--runs", str(tmp_path), "--json"]) == 0
    (overview,) = json.loads(capsys.readouterr().out)
    assert overview["outcome"] == "broken off"
