"""A run that is told to stop: the wheels stand still, the journal says who stopped it, nothing is lost."""

import os
import pty
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import can
import pytest

from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.journal.journal import read

LONGEST_S = 60.0
"""To start up and to draw a few frames on a busy machine; a bound, not an expectation."""
SCREEN_BYTES = 65536
LOOK_S = 0.05
"""Between two looks at what a process has done, which needs the processor, too."""
MODULES, TRACKER_AND_TWO_JOBS = 4, 3


def last_drive_commands(path: Path) -> list[float]:
    """The last speed that each module was told, per mille."""
    layout, told = wire_layout(), {}
    for frame in can.CanutilsLogReader(path):
        telegram = layout.read(frame)
        if telegram is not None and telegram.kind is Kind.DRIVE:
            told[telegram.node] = telegram.values["DriveSpeed"]
    return list(told.values())


def fieldnav(*arguments: str, python: tuple[str, ...] = ()) -> subprocess.Popen[bytes]:
    command = [sys.executable, *python, "-m", "fieldnav", *arguments]
    return subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.PIPE)


def driving(
    folder: Path, quick_robot_file: Path, terminal: tuple[int, int] | None = None
) -> subprocess.Popen[bytes]:
    """A simulated run that has begun to follow a lane; a terminal, its two ends, becomes its own."""
    field = ["demo", "--sketch", "--lanes", "1", "--length", "20"]
    arguments = ["simulate", *field, "--robot", str(quick_robot_file), "--out", str(folder)]
    if terminal is None:
        run = fieldnav(*arguments)
    else:
        os.set_blocking(terminal[0], False)
        there = ["bash", "-c", 'exec "$@" <"$0" >"$0" 2>"$0"', os.ttyname(terminal[1])]
        command = [*there, sys.executable, "-m", "fieldnav", *arguments]
        run = subprocess.Popen(
            command, start_new_session=True
        )  # its first terminal is then the one it hears of
    until = time.monotonic() + LONGEST_S
    while not any(b"Tracking" in path.read_bytes() for path in folder.glob("*/journal.jsonl")):
        assert time.monotonic() < until, "the run begins to follow"
        with pytest.raises(subprocess.TimeoutExpired):  # it goes on until it is told to stop
            run.wait(LOOK_S)
        with suppress(BlockingIOError):
            if terminal is not None:
                os.read(terminal[0], SCREEN_BYTES)
    return run


def assert_ended_in_good_order(run: subprocess.Popen[bytes], runs: Path) -> Path:
    """One line, the status of an interruption, the wheels at rest, a whole journal, no litter."""
    _, said = run.communicate(timeout=LONGEST_S)
    assert (run.returncode, said.decode()) == (130, "error: interrupted\n")
    (folder,) = runs.iterdir()
    assert read(folder / "journal.jsonl")[-1].reason == "interrupted by the operator"
    assert last_drive_commands(folder / "can.log") == [0] * MODULES
    assert (folder / "summary.json").exists()
    assert not list(folder.glob(".*"))
    return folder


@pytest.mark.parametrize("stop", [signal.SIGTERM, signal.SIGHUP])
def test_a_run_that_is_told_to_stop_leaves_its_wheels_at_zero(
    stop: signal.Signals, tmp_path: Path, quick_robot_file: Path
) -> None:
    run = driving(tmp_path, quick_robot_file)
    run.send_signal(stop)

    assert_ended_in_good_order(run, tmp_path)


def test_a_run_that_was_told_to_stop_is_replayed_without_a_difference(
    tmp_path: Path, quick_robot_file: Path
) -> None:
    run = driving(tmp_path, quick_robot_file)
    run.send_signal(signal.SIGINT)
    folder = assert_ended_in_good_order(run, tmp_path)

    with fieldnav("replay", str(folder)) as again:
        said, _ = again.communicate(timeout=LONGEST_S)
    assert (again.returncode, b"no difference" in said) == (0, True), said


def test_a_run_that_is_told_to_end_at_once_leaves_its_wheels_at_zero(
    tmp_path: Path, quick_robot_file: Path
) -> None:
    run = driving(tmp_path, quick_robot_file)
    run.send_signal(signal.SIGQUIT)

    assert_ended_in_good_order(run, tmp_path)


def test_a_run_that_is_told_to_stop_again_and_again_leaves_its_wheels_at_zero(
    tmp_path: Path, quick_robot_file: Path
) -> None:
    run = driving(tmp_path, quick_robot_file)
    while run.poll() is None:
        run.send_signal(signal.SIGINT)
        with suppress(subprocess.TimeoutExpired):
            run.wait(LOOK_S)

    _, said = run.communicate(timeout=LONGEST_S)

    assert b"Traceback" not in said and b"ignored" not in said
    (folder,) = tmp_path.iterdir()
    assert last_drive_commands(folder / "can.log") == [0] * MODULES
    assert not list(folder.glob(".*"))


def test_a_run_whose_terminal_is_closed_stops_in_good_order(tmp_path: Path, quick_robot_file: Path) -> None:
    terminal = pty.openpty()
    run = driving(tmp_path, quick_robot_file, terminal)
    for end in terminal:
        os.close(end)

    run.wait(LONGEST_S)

    assert run.returncode == 130
    (folder,) = tmp_path.iterdir()
    assert read(folder / "journal.jsonl")[-1].reason == "interrupted by the operator"
    assert (folder / "summary.json").exists()


def test_a_run_that_is_killed_leaves_no_file_that_means_nothing(
    tmp_path: Path, quick_robot_file: Path
) -> None:
    run = driving(tmp_path, quick_robot_file)
    run.kill()
    run.communicate(timeout=LONGEST_S)

    (folder,) = tmp_path.iterdir()
    assert not list(folder.glob(".*"))


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT])
@pytest.mark.parametrize("loaded", [b"click.core", b"rich.console", b"fieldnav.cli.app"])
def test_a_command_that_is_interrupted_while_it_loads_says_so_in_one_line(
    loaded: bytes, stop: signal.Signals
) -> None:
    with fieldnav("bench", "faults", python=("-X", "importtime")) as command:
        assert command.stderr is not None
        while loaded not in (line := command.stderr.readline()):
            assert line, "the module is loaded"
        command.send_signal(stop)
        said = command.stderr.read().splitlines()

    own = [line for line in said if not line.startswith(b"import time:")]
    assert (command.returncode, own) == (130, [b"error: interrupted"])


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_served_robot_that_is_told_to_stop_tells_what_it_did(stop: signal.Signals, tmp_path: Path) -> None:
    robot = str(tmp_path / "served.yaml")
    with fieldnav("simulate", "demo", "--serve", "--sketch", "--json", "--robot-file", robot) as serving:
        assert serving.stdout is not None
        assert b"robot_file" in serving.stdout.readline()
        serving.send_signal(stop)
        told, said = serving.communicate(timeout=LONGEST_S)

    assert (serving.returncode, said) == (0, b"")
    assert b"truth" in told


def test_ctrl_c_at_a_terminal_ends_a_benchmark_and_all_its_processes_without_a_word_of_theirs() -> None:
    command = [sys.executable, "-m", "fieldnav", "bench", "faults", "--quick", "--jobs", "2"]
    with subprocess.Popen(
        command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
    ) as bench:
        children = Path(f"/proc/{bench.pid}/task/{bench.pid}/children")
        while len(children.read_text().split()) < TRACKER_AND_TWO_JOBS:
            with pytest.raises(subprocess.TimeoutExpired):
                bench.wait(LOOK_S)
        os.killpg(bench.pid, signal.SIGINT)
        _, said = bench.communicate(timeout=LONGEST_S)

    assert (bench.returncode, said.decode()) == (130, "error: interrupted\n")
