"""`fieldnav log why` of a run with a recording: what was judged before, the half minute, the picture."""

import json
from collections.abc import Callable
from pathlib import Path

import cv2
import pytest

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory

from .made_stuck import HEIGHT_PX, STUCK_S, WIDTH_PX

Printed = Callable[[], str]


@pytest.mark.usefixtures("recorded")
def test_of_a_stop_that_nothing_judged_the_recording_knows_what_was_judged_before(printed: Printed) -> None:
    assert run(["log", "why"]) == 0

    text = printed()
    assert "what Forward.Exit judged" in text
    (left,) = (line.split() for line in text.splitlines() if line.startswith("lane left"))
    assert left[:4] == ["lane", "left", "0.6", "m"]
    assert "speed told to the wheels: 0 m/s\n     0.5 │" in text, "wheels that turn into place do not drive"
    assert "7 pictures are missing from 0:43.0 to 0:44.0: the disk was too slow" in text


@pytest.mark.usefixtures("recorded")
def test_the_half_minute_before_is_drawn_against_its_threshold(printed: Printed) -> None:
    assert run(["log", "why", "2"]) == 0

    text = printed()
    assert "the half minute before, from 0:10.0 to 0:40.0" in text
    assert "probability: 0.51, threshold 0.5" in text
    assert "speed told to the wheels: 0.5 m/s, all the time" in text
    assert any(0x2800 < ord(character) <= 0x28FF for character in text)


@pytest.mark.usefixtures("recorded")
def test_a_moment_without_a_change_is_told_by_the_recording(printed: Printed) -> None:
    assert run(["log", "why", "last", "20.0"]) == 0

    first = printed().splitlines()[0]
    assert first.endswith("nearest was lane ended, but probability 0.26 < 0.5")


def test_the_picture_that_decided_lies_in_the_runs_directory(
    recorded: RunDirectory, printed: Printed
) -> None:
    assert run(["log", "why", "2"]) == 0

    path = Path("runs") / recorded.path.name / "why-2.jpg"
    assert f"picture: {path}" in printed()
    image = cv2.imread(str(path))
    assert image is not None and image.shape[0] > HEIGHT_PX and image.shape[1] == WIDTH_PX
    row = image[HEIGHT_PX // 2, 145:165].astype(int)
    assert (row[:, 1] - row[:, 2]).max() > 40, "the row is drawn in green"


def test_no_picture_is_saved_when_none_is_wanted(recorded: RunDirectory, printed: Printed) -> None:
    assert run(["log", "why", "2", "--no-picture"]) == 0

    assert "picture:" not in printed()
    assert list(recorded.path.glob("why-*")) == []


def test_a_picture_that_cannot_be_written_is_said_and_no_failure(
    recorded: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    (recorded.path / "why-2.jpg").mkdir()

    assert run(["log", "why", "2"]) == 0

    captured = capsys.readouterr()
    assert captured.out.startswith("lane ended at 0:40.0")
    assert captured.err.startswith("error: ") and "why-2.jpg: cannot be written" in captured.err


def test_programs_get_all_of_it_as_json(recorded: RunDirectory, printed: Printed) -> None:
    assert run(["log", "why", "--json"]) == 0

    told = json.loads(printed())
    assert told["headline"].startswith("stopped at 0:45.0 in lane 1")
    assert (told["kind"], told["fault"], told["at_s"]) == ("stopped", "steering stuck", STUCK_S)
    assert told["advice"] == "look for a stone or a stalk"
    assert (told["judged"][0]["margin"], told["judged"][0]["holds"]) == (-0.6, False)
    assert told["events"] == [
        {"event": "lane left", "holds": False, "decided_by": ["to the stop"], "margins": [-0.6]}
    ]
    assert (told["before"]["seq"], told["line"]["seq"], told["after"]) == (2, 3, None)
    assert told["picture"] == str(Path("runs") / recorded.path.name / "why-3.jpg")


def test_a_recording_that_is_none_does_not_keep_the_journal_from_being_told(
    directory: RunDirectory, printed: Printed
) -> None:
    directory.recording.write_bytes(b"no recording at all")

    assert run(["log", "why"]) == 0

    assert "the recording cannot be shown: " in printed()
