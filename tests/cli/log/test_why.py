"""`fieldnav log why`: the cause, what was judged, what was near, the half minute before, a picture."""

import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry, Judged
from fieldnav.journal.journal import Journal
from fieldnav.messages import Bound, CameraName, Evidence, Frame
from fieldnav.recording.foxglove import compressed_image
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.recorder import Recorder
from fieldnav.recording.records import Gap, Line, Record, Seen, Stepped, Ticked
from fieldnav.settings.recording import RecordingSettings
from states.names import Event

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
TRACKING, EXIT = "Forward.Follow.Tracking", "Forward.Exit"
HEIGHT_PX, WIDTH_PX = 180, 320
ENDED_S, HELD_S, STUCK_S = 40.0, 44.0, 45.0
RATE_S = 0.2
Printed = Callable[[], str]


@dataclass(frozen=True, slots=True)
class Item:
    """A message that waits to be recorded."""

    message: Message
    picture: bool = False

    @property
    def size(self) -> int:
        return len(self.message.data)

    def messages(self) -> Iterable[Message]:
        return (self.message,)


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Printed:
    return lambda: capsys.readouterr().out


@pytest.fixture
def directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> RunDirectory:
    """A run in the folder `runs` that leaves a lane, and whose steering is then stuck."""
    monkeypatch.chdir(tmp_path)
    directory = RunDirectory.create(tmp_path / "runs", "demo", START)
    frame = Frame(CameraName.FRONT, 200, ENDED_S - RATE_S / 2, np.zeros((2, 2, 3), np.uint8))
    ended = (
        Evidence("probability", 0.51, 0.5, fires=Event.LANE_ENDED),
        Evidence("rows seen", 3, 1.5, "rows", Event.ROWS_LOST, Bound.BELOW),
        Evidence("offset from the lane", 0.01, None, "m"),
    )
    stuck = "steering stuck: module front_left stands 14 degrees from the angle it was told"
    with Journal(directory.journal, START) as journal:
        journal.record(Entry(0.4, "ready", "Checking", "Forward.Follow.Acquiring", 1, 0))
        journal.record(Entry(1.0, "rows found", "Forward.Follow.Acquiring", TRACKING, 1, 3))
        journal.record(Entry(ENDED_S, "lane ended", TRACKING, EXIT, 1, 3, ended, frame))
        journal.record(Entry(STUCK_S, "latch", EXIT, "Fault.Latched", 1, 3, reason=stuck))
    return directory


@pytest.fixture
def recorded(directory: RunDirectory) -> RunDirectory:
    """The same with a recording of every frame of the front camera."""
    with Recorder(directory, RecordingSettings(keep_free_gb=0), START, waits=True) as recorder:
        for item in _items():
            recorder.put(item)
    return directory


def _items() -> Iterator[Item]:
    picture = np.full((HEIGHT_PX, WIDTH_PX, 3), (72, 96, 122), np.uint8)
    jpeg = cv2.imencode(".jpg", picture)[1].tobytes()
    for number in range(1, round(STUCK_S / RATE_S)):
        now_s = number * RATE_S
        seen = Seen(camera=CameraName.FRONT, sequence=number, stamp_s=now_s - RATE_S / 2)
        data = compressed_image(CameraName.FRONT, START, jpeg)
        yield Item(Message(Topic.FRONT_IMAGE, seen.stamp_s, data, number), picture=True)
        yield _record(Topic.STEP, now_s, _step(now_s, seen))
        yield _record(Topic.TICK, now_s, _tick(now_s))
    yield _record(Topic.GAP, 44.0, Gap(from_s=43.0, to_s=44.0, frames=7))


def _record(topic: Topic, stamp_s: float, record: Record) -> Item:
    return Item(Message(topic, stamp_s, record.model_dump_json().encode()))


def _step(now_s: float, seen: Seen) -> Stepped:
    """The probability rises to the lane's end; then the way to where the robot is to stop is judged."""
    tracking = Judged(name="probability", value=now_s / 80 + 0.01, threshold=0.5, fires="lane ended")
    leaving = Judged(
        name="to the stop",
        value=3 - (now_s - ENDED_S) / 2,
        threshold=0,
        unit="m",
        fires="lane left",
        bound=Bound.AT_MOST,
    )
    before = now_s <= ENDED_S
    return Stepped(
        now_s=now_s,
        state=TRACKING if before else EXIT,
        lane=1,
        forward_m=now_s / 2,
        evidence=(tracking if before else leaving,),
        frame=seen,
        rows=(Line(x_top_px=150, x_bottom_px=160, confidence=1),),
    )


def _tick(now_s: float) -> Ticked:
    state = TRACKING if now_s <= ENDED_S else EXIT
    still = dict.fromkeys(("sideways_m", "x_m", "y_m", "heading_rad", "vy_mps", "yaw_rate_rps"), 0.0)
    counts = dict.fromkeys(("lane", "rows", "rows_passed"), 1)
    return Ticked.model_validate(
        {
            "now_s": now_s,
            "state": state,
            "forward_m": now_s / 2,
            "vx_mps": 0.5,
            "hold": now_s > HELD_S,
            **still,
            **counts,
        }
    )


@pytest.mark.usefixtures("directory")
@pytest.mark.parametrize(
    ("arguments", "first"),
    [
        ([], "stopped at 0:45.0 in lane 1, Forward.Exit -> Fault.Latched: steering stuck: module front_left"),
        (["last"], "stopped at 0:45.0"),
        (
            ["demo", "2"],
            "lane ended at 0:40.0 in lane 1, Forward.Follow.Tracking -> Forward.Exit: probability",
        ),
        (["2"], "lane ended at 0:40.0"),
        (["40.3"], "lane ended at 0:40.0"),
        (["0:40"], "lane ended at 0:40.0"),
        (["41s"], "lane ended at 0:40.0"),
        (["last", "20.0"], "nothing changed at 0:20.0 in lane 1, Forward.Follow.Tracking since 0:01.0"),
    ],
)
def test_run_and_moment_are_told_apart(arguments: list[str], first: str, printed: Printed) -> None:
    assert run(["log", "why", *arguments]) == 0

    assert printed().splitlines()[0].startswith(first)


@pytest.mark.usefixtures("directory")
def test_without_a_recording_the_journal_tells_what_it_can_and_says_so(printed: Printed) -> None:
    assert run(["log", "why", "2"]) == 0

    text = printed()
    assert "what Forward.Follow.Tracking judged" in text
    (ended,) = (line.split() for line in text.splitlines() if line.startswith("probability "))
    assert ended == ["probability", "0.51", ">=", "0.5", "+0.01", "lane", "ended"]
    (lost,) = (line.split() for line in text.splitlines() if line.startswith("rows lost"))
    assert lost == ["rows", "lost", "1.5", "rows", "rows", "seen", "3", ">", "1.5", "rows"]
    assert "this run has no recording: the journal alone is shown" in text
    before, here, after = (line.split()[:3] for line in text.splitlines()[-3:])
    assert (before, here, after) == (
        ["before", "1", "0:01.0"],
        ["here", "2", "0:40.0"],
        ["after", "3", "0:45.0"],
    )


@pytest.mark.usefixtures("directory")
def test_a_stop_is_followed_by_what_to_look_at(printed: Printed) -> None:
    assert run(["log", "why"]) == 0

    _, advice, meaning, *_ = printed().splitlines()
    assert advice == "look at: look for a stone or a stalk"
    assert meaning == "steering stuck means: a wheel's angle does not follow its set-point"


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


@pytest.mark.usefixtures("directory")
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["last", "noon"], "'noon': is no moment of a run; allowed is a line's number such as 17, or a time"),
        (["last", "17"], "no line 17 in the journal; allowed is 0 to 3"),
        (["nowhere"], "no run 'nowhere' in runs"),
    ],
)
def test_what_cannot_be_answered_is_one_line(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["log", "why", *arguments]) == 2

    captured = capsys.readouterr()
    assert captured.out == "" and said in captured.err


def test_a_recording_that_is_none_does_not_keep_the_journal_from_being_told(
    directory: RunDirectory, printed: Printed
) -> None:
    directory.recording.write_bytes(b"no recording at all")

    assert run(["log", "why"]) == 0

    assert "the recording cannot be shown: " in printed()
