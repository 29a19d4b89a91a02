"""The ledger: its last whole line counts, whatever became of the process that wrote it."""

import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.errors import FieldnavError, OutputError
from fieldnav.journal.ledger import LAST_BYTES, Booking, Ledger, last_booking

BEGINNING = (
    "import os, resource, signal, sys; from pathlib import Path\n"
    "from fieldnav.errors import OutputError\n"
    "from fieldnav.journal.ledger import Booking, Ledger\n"
    "def booking(lane): return Booking(stamp_s=lane, state='Forward.Exit', side='left', lanes=9,\n"
    "    lane=lane, done=(), rows=0, forward_m=0, sideways_m=0)\n"
)


def booking(lane: int) -> Booking:
    return Booking(
        stamp_s=lane / 3,
        state="Forward.Exit",
        side="right",
        lanes=9,
        lane=lane,
        done=tuple(range(1, lane)),
        rows=3,
        forward_m=4.2,
        sideways_m=-1 / 3,
        lane_from_m=0.5,
        pitches_m=(1.5, 1.48),
        finished=lane == 9,
    )


def run(program: str, path: Path) -> str:
    """What a program of its own process prints."""
    done = subprocess.run(
        [sys.executable, "-c", BEGINNING + program, str(path)], capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    return done.stdout


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "ledger.jsonl"


def test_the_last_line_counts_and_lines_are_only_appended(path: Path) -> None:
    with Ledger(path) as ledger:
        ledger.book(booking(1))
        first = path.read_bytes()
        ledger.book(booking(9))

    assert path.read_bytes().startswith(first)
    assert last_booking(path) == booking(9)


def test_a_ledger_is_continued_where_another_process_left_it(path: Path) -> None:
    for lane in (1, 2):
        with Ledger(path) as ledger:
            ledger.book(booking(lane))

    assert len(path.read_bytes().splitlines()) == 2
    assert last_booking(path) == booking(2)


def test_no_ledger_and_an_empty_one_say_nothing(path: Path) -> None:
    assert last_booking(path) is None

    path.touch()

    assert last_booking(path) is None
    with Ledger(path) as ledger:
        ledger.book(booking(1))
    assert last_booking(path) == booking(1)


@settings(max_examples=30)  # each waits for the disk
@given(cut=st.integers(1, 180))
def test_a_line_torn_at_any_byte_does_not_count_and_is_cut_off(
    cut: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("run") / "ledger.jsonl"
    with Ledger(path) as ledger:
        ledger.book(booking(1))
        whole = path.read_bytes()
        ledger.book(booking(2))
    path.write_bytes(path.read_bytes()[:-cut])

    assert last_booking(path) == booking(1)
    with Ledger(path) as ledger:
        assert path.read_bytes() == whole
        ledger.book(booking(3))
    assert last_booking(path) == booking(3)


def test_a_first_line_that_is_torn_is_none(path: Path) -> None:
    with Ledger(path) as ledger:
        ledger.book(booking(1))
    path.write_bytes(path.read_bytes()[:50])

    assert last_booking(path) is None
    with Ledger(path):
        assert path.read_bytes() == b""


def test_of_a_long_ledger_only_the_end_is_read(path: Path) -> None:
    with Ledger(path) as ledger:
        ledger.book(booking(1))
    path.write_bytes(b"\x00" * LAST_BYTES + b"\n" + path.read_bytes() + b'{"stamp')

    assert last_booking(path) == booking(1)
    with Ledger(path) as ledger:
        ledger.book(booking(2))
    assert last_booking(path) == booking(2)


@pytest.mark.parametrize("line", [b"garbage", b"{}", b"\x00" * 40, b'{"stamp_s": NaN}', b"\xff"])
def test_a_last_line_that_is_none_of_a_ledgers_is_named(line: bytes, path: Path) -> None:
    path.write_bytes(line + b"\n")

    with pytest.raises(FieldnavError, match=r"ledger\.jsonl: its last line is none of a ledger's"):
        last_booking(path)


def test_a_ledger_that_cannot_be_read_or_written_says_so(tmp_path: Path) -> None:
    with pytest.raises(FieldnavError, match="cannot be read: Is a directory"):
        last_booking(tmp_path)
    with pytest.raises(OutputError, match="cannot be written: No such file or directory"):
        Ledger(tmp_path / "nowhere" / "ledger.jsonl")


def test_two_processes_never_drive_one_run(path: Path) -> None:
    program = (
        "try: Ledger(Path(sys.argv[1]))\nexcept OutputError as error: print(error)\nelse: print('no lock')"
    )

    with Ledger(path) as ledger:
        ledger.book(booking(1))
        said = run(program, path)

    assert said == f"{path}: another fieldnav drives this run\n"
    assert run(program, path) == "no lock\n"


def test_a_process_that_is_killed_leaves_every_line_and_no_lock(path: Path) -> None:
    program = (
        "ledger = Ledger(Path(sys.argv[1]))\n"
        "for lane in range(1, 6): ledger.book(booking(lane))\n"
        "os.kill(os.getpid(), signal.SIGKILL)"
    )

    run(program, path)

    newest = last_booking(path)
    assert newest is not None
    assert newest.lane == 5
    with Ledger(path) as ledger:
        ledger.book(booking(6))
    assert len(path.read_bytes().splitlines()) == 6


def test_a_ledger_that_is_deleted_while_it_is_written_is_an_error(path: Path) -> None:
    with Ledger(path) as ledger:
        ledger.book(booking(1))
        path.unlink()

        with pytest.raises(OutputError, match="cannot be written: it was deleted"):
            ledger.book(booking(1))


def test_a_full_disk_is_one_line_and_leaves_only_whole_lines(path: Path) -> None:
    program = (
        "resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))\n"
        "with Ledger(Path(sys.argv[1])) as ledger:\n"
        "    try:\n"
        "        for lane in range(1, 100): ledger.book(booking(lane))\n"
        "    except OutputError as error: print(error)\n"
    )

    said = run(program, path)

    assert said == f"{path}: cannot be written: File too large\n"
    assert path.read_bytes().endswith(b"\n")
    newest = last_booking(path)
    assert newest is not None
    assert newest.lane == len(path.read_bytes().splitlines()) > 1
