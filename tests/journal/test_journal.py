"""The journal is on the disk before the wheels obey, and readable whatever happened after."""

import json
import shutil
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.errors import FieldnavError, OutputError
from fieldnav.journal.entry import Entry, Judged, judged_as_json, line_of
from fieldnav.journal.journal import Journal, read
from fieldnav.messages import Bound, CameraName, Evidence, Frame, Twist
from states.names import Event

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
KEYS = [
    *("seq", "stamp_s", "utc", "event", "source", "target"),
    *("lane", "rows", "evidence", "frame", "command", "reason"),
    *("forward_m", "sideways_m"),
]
ENTRY = Entry(
    stamp_s=12.3456789,
    event="lane ended",
    source="Forward.Follow.Tracking",
    target="Forward.Exit",
    lane=1,
    rows=3,
    evidence=(
        Evidence("distance without plants", 0.21, 0.15, "m", fires=Event.LANE_ENDED),
        Evidence("plants", float("nan")),
    ),
    frame=Frame(CameraName.FRONT, 185, 12.28, np.zeros((2, 2, 3), np.uint8)),
    command=Twist(0.3, 0.0, -0.0),
)


def test_a_transition_becomes_one_line_with_all_that_was_judged(tmp_path: Path) -> None:
    with Journal(tmp_path / "journal.jsonl", START) as journal:
        journal.record(ENTRY)

    line = json.loads((tmp_path / "journal.jsonl").read_text())
    assert list(line) == KEYS
    assert (line["seq"], line["stamp_s"], line["utc"]) == (0, 12.345679, "2026-05-01T08:30:12.345Z")
    assert line["evidence"] == [
        {"name": "distance without plants", "value": 0.21, "threshold": 0.15, "unit": "m"}
        | {"fires": "lane ended", "bound": ">="},
        {"name": "plants", "value": None, "threshold": None, "unit": ""},
    ]
    assert line["frame"] == {"camera": "front", "sequence": 185, "stamp_s": 12.28}
    assert str(line["command"]) == "{'vx_mps': 0.3, 'vy_mps': 0.0, 'yaw_rate_rps': 0.0}"


def test_what_is_recorded_is_read_back(tmp_path: Path) -> None:
    with Journal(tmp_path / "journal.jsonl", START) as journal:
        journal.record(ENTRY)
        journal.record(Entry(13.0, "fail", "Forward.Exit", "Fault.Recoverable", reason="the camera is gone"))

    first, second = read(tmp_path / "journal.jsonl")
    assert (first.seq, second.seq) == (0, 1)
    assert first.evidence[0].value == 0.21
    assert first.evidence[1].value is None
    assert second.reason == "the camera is gone"


def test_the_same_entries_give_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        with Journal(tmp_path / name, START) as journal:
            journal.record(ENTRY)

    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_a_line_is_in_the_file_when_record_returns(tmp_path: Path) -> None:
    journal = Journal(tmp_path / "journal.jsonl", START)

    journal.record(ENTRY)

    assert len(read(tmp_path / "journal.jsonl")) == 1
    journal.close()


def test_a_process_that_is_killed_leaves_every_recorded_line(tmp_path: Path) -> None:
    program = (
        "import os, sys, signal; from datetime import *; from pathlib import Path\n"
        "from fieldnav.journal.journal import Journal; from fieldnav.journal.entry import Entry\n"
        "journal = Journal(Path(sys.argv[1]), datetime(2026, 5, 1, tzinfo=UTC))\n"
        "for number in range(5): journal.record(Entry(number, 'e', 's', 't'))\n"
        "os.kill(os.getpid(), signal.SIGKILL)"
    )

    subprocess.run([sys.executable, "-c", program, str(tmp_path / "journal.jsonl")], check=False)

    assert [line.stamp_s for line in read(tmp_path / "journal.jsonl")] == [0, 1, 2, 3, 4]


@settings(max_examples=30)  # each waits for the disk
@given(cut=st.integers(1, 400))
def test_a_journal_torn_at_any_byte_reads_up_to_its_last_whole_line_and_goes_on(
    cut: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("run") / "journal.jsonl"
    with Journal(path, START) as journal:
        journal.record(ENTRY)
        journal.record(ENTRY)
    path.write_bytes(path.read_bytes()[:-cut])

    assert [line.seq for line in read(path)] == [0]
    with Journal(path, START) as journal:
        journal.record(ENTRY)
    assert [line.seq for line in read(path)] == [0, 1]


def test_a_wrong_line_in_the_middle_is_named(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    with Journal(path, START) as journal:
        journal.record(ENTRY)
    path.write_bytes(b"garbage\n" + path.read_bytes())

    with pytest.raises(FieldnavError, match="line 1 is not a line of a journal"):
        read(path)


def test_a_journal_that_cannot_be_written_says_so(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written: No such file or directory"):
        Journal(tmp_path / "nowhere" / "journal.jsonl", START)


def test_a_full_disk_is_one_line_and_leaves_only_whole_lines(tmp_path: Path) -> None:
    program = (
        "import resource, sys; from datetime import *; from pathlib import Path\n"
        "from fieldnav.errors import OutputError\n"
        "from fieldnav.journal.journal import Journal; from fieldnav.journal.entry import Entry\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (70000, 70000))\n"
        "with Journal(Path(sys.argv[1]), datetime(2026, 5, 1, tzinfo=UTC)) as journal:\n"
        "    try:\n"
        "        for number in range(1000): journal.record(Entry(number, 'e', 's', 't'))\n"
        "    except OutputError as error: print(error)\n"
    )

    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "journal.jsonl")],
        capture_output=True,
        text=True,
        check=True,
    )

    assert (done.stdout, done.stderr) == (
        f"{tmp_path}/journal.jsonl: cannot be written: File too large\n",
        "",
    )
    content = (tmp_path / "journal.jsonl").read_bytes()
    assert content.endswith(b"\n")
    assert len(content) < 70000
    assert len(read(tmp_path / "journal.jsonl")) > 1


def test_a_journal_that_is_deleted_while_it_is_written_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    path = tmp_path / "run" / "journal.jsonl"
    with Journal(path, START) as journal:
        journal.record(ENTRY)
        shutil.rmtree(path.parent)

        with pytest.raises(OutputError, match=r"journal\.jsonl: cannot be written: it was deleted"):
            journal.record(ENTRY)


@given(st.floats())
def test_any_number_at_all_becomes_json(value: float) -> None:
    entry = Entry(1.0, "e", "s", "t", evidence=(Evidence("x", value, value, "m"),))

    json.dumps(line_of(entry, 0, START), allow_nan=False)


def test_a_stray_carriage_return_hides_none_of_the_lines_after_it(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    with Journal(path, START) as journal:
        for _ in range(3):
            journal.record(ENTRY)
    first, second, third, _ = path.read_bytes().split(b"\n")

    path.write_bytes(b"\n".join([first, b"\r" + second + b"\r", third, b""]))
    assert [line.seq for line in read(path)] == [0, 1, 2]

    path.write_bytes(b"\n".join([first, second[:40] + b"\r" + b"x" + second[40:], third, b""]))
    with pytest.raises(FieldnavError, match="line 2 is not a line"):
        read(path)


def test_rounding_never_gainsays_what_was_decided() -> None:
    past, limit = 15.000000000000002, 15.0
    just = Evidence("waited", past, limit, "s", Event.FAIL, Bound.ABOVE)

    judged = Judged.model_validate(judged_as_json(just))

    assert judged.holds
    assert judged.value == past
