"""`fieldnav log` stats, diff, tail and export."""

import csv
import io
import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest
from mcap.reader import make_reader

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry, Judged
from fieldnav.journal.journal import Journal, read
from fieldnav.journal.summary import Lanes, LoopHealth, Summary, Switches, write_summary
from fieldnav.messages import Bound, Evidence
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.recorder import Recorder
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Record, Stepped, Ticked
from fieldnav.settings.recording import RecordingSettings
from states.names import Event

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
TRACKING, EXIT = "Forward.Follow.Tracking", "Forward.Exit"
ENDED = Evidence("probability", 0.52, 0.5, fires=Event.LANE_ENDED)
ENTRIES = (
    Entry(1.0, "rows found", "Forward.Follow.Acquiring", TRACKING, 1, 3, forward_m=0.0, sideways_m=0.0),
    Entry(11.0, "held by the gate", TRACKING, TRACKING, 1, 3, reason="camera black: front", forward_m=5.0),
    Entry(21.0, "lane ended", TRACKING, EXIT, 1, 3, (ENDED,), forward_m=10.0, sideways_m=0.0),
    Entry(23.5, "latch", EXIT, "Fault.Latched", 1, 3, reason="bus off: gone", forward_m=11.0, sideways_m=0.0),
)
NEAR = Judged(name="rows seen", value=1.6, threshold=1.5, unit="rows", fires="rows lost", bound=Bound.BELOW)
FAR = NEAR.model_copy(update={"value": 3.0})
Printed = Callable[[], str]
Made = Callable[..., RunDirectory]


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Printed:
    return lambda: capsys.readouterr().out


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Made:
    """Makes a run of these entries, with its summary, in the folder `runs`."""
    monkeypatch.chdir(tmp_path)

    def make(name: str = "demo", entries: Sequence[Entry] = ENTRIES) -> RunDirectory:
        directory = RunDirectory.create(Path("runs"), name, START)
        with Journal(directory.journal, START) as journal:
            for entry in entries:
                journal.record(entry)
        figures = Summary(
            completed=False,
            lanes=Lanes(done=0, total=3),
            distance_m=11.0,
            duration_s=23.5,
            wall_s=23.5,
            realtime_factor=1.0,
            transitions=3,
            faults=1,
            switches=Switches(attempted=0, succeeded=0),
            loop=LoopHealth(rounds=1175, late_p99_ms=2.5, late_max_ms=9.5),
        )
        write_summary(directory.summary, figures)
        return directory

    return make


def record(directory: RunDirectory, settings: RecordingSettings | None = None) -> None:
    """Rows that were nearly lost at 5 s, and three ticks."""
    with Recorder(directory, settings or RecordingSettings(keep_free_gb=0), START, waits=True) as recorder:
        for now_s, judged in ((4.0, FAR), (5.0, NEAR), (6.0, FAR)):
            step = Stepped(now_s=now_s, state=TRACKING, lane=1, forward_m=now_s / 2, evidence=(judged,))
            recorder.put(Item(Topic.STEP, now_s, step))
            recorder.put(Item(Topic.TICK, now_s, _tick(now_s)))


class Item:
    """A record that waits to be recorded."""

    picture = False

    def __init__(self, topic: Topic, stamp_s: float, record: Record) -> None:
        self._message = Message(topic, stamp_s, record.model_dump_json().encode())

    @property
    def size(self) -> int:
        return len(self._message.data)

    def messages(self) -> Sequence[Message]:
        return (self._message,)


def _tick(now_s: float) -> Ticked:
    still = dict.fromkeys(("sideways_m", "x_m", "y_m", "heading_rad", "vy_mps", "yaw_rate_rps"), 0.0)
    counts = dict.fromkeys(("lane", "rows", "rows_passed"), 1)
    modules = {"front_left": {"speed_mps": 0.49}}
    plain = {"now_s": now_s, "state": TRACKING, "forward_m": now_s / 2, "vx_mps": 0.5, "modules": modules}
    return Ticked.model_validate(plain | still | counts)


def test_stats_add_up_time_way_margins_faults_and_lateness(made: Made, printed: Printed) -> None:
    made()

    assert run(["log", "stats"]) == 0

    text = printed()
    (tracking,) = (line.split() for line in text.splitlines() if line.startswith(TRACKING))
    assert tracking == [TRACKING, "0:20.0", "88.9%", "10.0", "m", "1", "20.0", "s"]
    (ended,) = (line.split() for line in text.splitlines() if line.startswith("lane ended"))
    assert ended == ["lane", "ended", "probability", "1", "0.02", "0.02", "0.02"]
    assert ["bus", "off", "1", "0"] in [line.split() for line in text.splitlines()]
    assert ["camera", "black", "0", "1"] in [line.split() for line in text.splitlines()]
    assert "near misses are not known: this run has no recording" in text
    assert "lateness of the loop: 99 % within 2.5 ms, at most 9.5 ms, 1175 rounds" in text


def test_stats_name_what_nearly_came_about(made: Made, printed: Printed) -> None:
    record(made())

    assert run(["log", "stats", "--json"]) == 0

    told = json.loads(printed())
    (missed,) = told["near_misses"]
    assert (missed["at_s"], missed["event"], missed["by"]) == (5.0, "rows lost", ["rows seen"])
    assert missed["lacking_share"] == pytest.approx(0.1 / 1.5)
    assert told["states"][EXIT]["seconds"] == 2.5
    assert told["lanes"]["1"] == {"transitions": 3, "coastings": 0, "holds": 1, "stops": 1}
    assert told["stops"] == {"bus off": 1}


def test_runs_that_are_alike_are_one_line(made: Made, printed: Printed) -> None:
    made("one")
    made("other")

    assert run(["log", "diff", "one", "other"]) == 0

    assert printed() == "the same 3 transitions in 20260501T083000Z-one and 20260501T083000Z-other\n"


def test_runs_that_differ_are_told_apart_by_transition_and_status(made: Made, printed: Printed) -> None:
    made("one")
    later = replace(ENTRIES[2], stamp_s=21.8, forward_m=10.4)
    made("other", [*ENTRIES[:2], later])

    assert run(["log", "diff", "one", "other"]) == 1
    text = printed()
    (moved,) = (line for line in text.splitlines() if " moved " in line and "lane ended" in line)
    assert "10.00 m, 0:21.0" in moved and "10.40 m, 0:21.8" in moved and "+0.40 m, +0.8 s" in moved
    assert text.splitlines()[-1] == "1 moved, 1 missing"

    assert run(["log", "diff", "one", "other", "--json"]) == 1
    assert [each["change"] for each in json.loads(printed())] == ["moved", "missing"]


def test_the_tail_of_a_run_that_has_ended_is_its_last_lines(made: Made, printed: Printed) -> None:
    made()

    assert run(["log", "tail", "--last", "2"]) == 0

    ended, stopped, *_ = printed().splitlines()
    assert ended.split("  ")[-1] == "probability 0.52 > 0.5"
    assert stopped.endswith("latch  Forward.Exit -> Fault.Latched  bus off: gone")


def test_the_tail_for_programs_is_a_line_of_json_each(made: Made, printed: Printed) -> None:
    made()

    assert run(["log", "tail", "--json"]) == 0

    assert [json.loads(line)["seq"] for line in printed().splitlines()] == [0, 1, 2, 3]


def test_a_table_has_a_row_a_line_and_a_column_a_quantity(made: Made, printed: Printed) -> None:
    made()

    assert run(["log", "export", "--csv", "-"]) == 0

    table = list(csv.DictReader(io.StringIO(printed())))
    assert [row["event"] for row in table] == ["rows found", "held by the gate", "lane ended", "latch"]
    ended = table[2]
    assert (ended["probability"], ended["probability: threshold"], ended["probability: margin"]) == (
        "0.52",
        "0.5",
        "0.02",
    )
    assert (ended["forward_m"], ended["utc"]) == ("10.0", "2026-05-01T08:30:21.000Z")
    assert table[3]["reason"] == "bus off: gone" and table[3]["probability"] == ""


def test_a_table_of_ticks_has_a_row_a_tick_and_the_wheels_in_it(made: Made, printed: Printed) -> None:
    record(made())

    assert run(["log", "export", "--csv", "ticks.csv", "--ticks"]) == 0

    table = list(csv.DictReader(io.StringIO(Path("ticks.csv").read_text())))
    assert [row["now_s"] for row in table] == ["4.0", "5.0", "6.0"]
    assert (table[0]["front_left_speed_mps"], table[0]["rear_left_speed_mps"]) == ("0.49", "")


def test_a_recording_in_pieces_becomes_one_file_that_says_the_same(made: Made, printed: Printed) -> None:
    directory = made()
    for _ in range(2):  # a run that is resumed goes on in a piece of its own
        record(directory)

    assert run(["log", "export", "--mcap", "whole.mcap"]) == 0

    copied = RunDirectory(Path("copy"))
    copied.path.mkdir()
    Path("whole.mcap").rename(copied.recording)
    with Recording.open(copied) as whole, Recording.open(directory) as pieces:  # type: ignore[union-attr]
        assert list(whole.steps()) == list(pieces.steps()) != []
        assert list(whole.ticks()) == list(pieces.ticks())


def test_without_a_recording_the_file_holds_the_journal(made: Made) -> None:
    directory = made()

    assert run(["log", "export", "--mcap", "journal.mcap"]) == 0

    with Path("journal.mcap").open("rb") as file:
        messages = [(channel.topic, message) for _, channel, message in make_reader(file).iter_messages()]
    assert {topic for topic, _ in messages} == {Topic.TRANSITION.value}
    assert [json.loads(message.data)["seq"] for _, message in messages] == [0, 1, 2, 3]
    first = read(directory.journal)[0]
    assert messages[0][1].log_time == round(first.utc.timestamp() * 1e9)


@pytest.mark.parametrize("option", ["--csv", "--mcap"])
def test_a_file_that_exists_is_kept_unless_it_may_be_lost(
    option: str, made: Made, capsys: pytest.CaptureFixture[str]
) -> None:
    made()
    Path("mine").write_text("precious")

    assert run(["log", "export", option, "mine"]) == 2
    assert Path("mine").read_text() == "precious"
    assert f"{option}: mine: exists; allowed is another name, or --force" in capsys.readouterr().err

    assert run(["log", "export", option, "mine", "--force"]) == 0
    assert Path("mine").read_bytes() != b"precious"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "allowed is either --csv FILE or --mcap FILE"),
        (["--csv", "a", "--mcap", "b"], "allowed is either --csv FILE or --mcap FILE"),
        (["--mcap", "b", "--ticks"], "--ticks: allowed with --csv only"),
        (["--csv", "-", "--ticks"], "has no recording; allowed is to leave it out"),
        (["--mcap", "-"], "--mcap: '-': allowed is the name of a file"),
        (["--csv", "runs"], "--csv: runs: is a folder; allowed is the name of a file"),
        (["--csv", "nowhere/a"], "nowhere/a: cannot be written: No such file or directory"),
        (["--mcap", "nowhere/a"], "nowhere/a: cannot be written: No such file or directory"),
    ],
)
def test_what_cannot_be_exported_is_one_line(
    options: list[str], said: str, made: Made, capsys: pytest.CaptureFixture[str]
) -> None:
    made()

    assert run(["log", "export", *options]) == 2

    captured = capsys.readouterr()
    assert captured.out == "" and said in captured.err
    assert [path.name for path in Path().iterdir()] == ["runs"]
