"""`fieldnav simulate --serve`: a process of its own that is watched, driven a little and ended."""

import json
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import can
import pytest

from fieldnav.cli.app import run
from fieldnav.settings.loading import load_robot

LIMIT_S = 30.0
OPTIONS = ("simulate", "demo", "--serve", "--sketch", "--lanes", "1", "--length", "6")

Process = subprocess.Popen[str]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[object]:
    """Starts commands in an empty folder; none outlives the test."""
    started: list[Process] = []

    def command(*options: str) -> Process:
        started.append(
            subprocess.Popen(
                [sys.executable, "-m", "fieldnav", *OPTIONS, *options],
                cwd=tmp_path,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
            )
        )
        return started[-1]

    yield command
    for process in started:
        process.kill()
        process.communicate()


def ended(process: Process, number: signal.Signals) -> list[str]:
    """What it says after a signal; it must end well and quietly."""
    process.send_signal(number)
    said, complaints = process.communicate(timeout=LIMIT_S)
    assert (process.returncode, complaints) == (0, "")
    return said.splitlines()


def test_a_program_is_told_where_everything_is_and_what_was_truly_done(start, tmp_path: Path) -> None:
    process = start("--json")

    offered = json.loads(process.stdout.readline())
    robot = load_robot(tmp_path / offered["robot_file"])
    bus = can.Bus(robot.can.channel, robot.can.interface, ignore_config=True, **robot.can.options)
    frame = bus.recv(timeout=LIMIT_S)
    bus.shutdown()
    last = json.loads(ended(process, signal.SIGTERM)[-1])

    assert frame is not None and frame.arbitration_id in range(0x701, 0x705)
    assert offered["robot_file"] == "served-robot.yaml"
    assert offered["can"]["options"] == robot.can.options
    assert offered["cameras"] == {"front": robot.cameras.front.source, "rear": robot.cameras.rear.source}
    assert last["truth"]["lanes_missed"] == 1 and last["distance_m"] == 0
    assert set(last["pose"]) == {"x_m", "y_m", "heading_deg"}


def test_a_person_is_told_how_to_drive_it(start) -> None:
    process = start("--side", "left", "--robot-file", "mine.yaml")

    line = process.stdout.readline()
    said = ended(process, signal.SIGINT)

    command = "fieldnav run --robot ./mine.yaml --crop sugar-beet --lanes 1 --side left"
    assert line == f"serving bonnbot in field demo: drive it with: {command}\n"
    assert any("lanes missed" in each for each in said) and any("stands at" in each for each in said)


def refused(*options: str) -> int:
    return run([*OPTIONS, *options])


def test_wrong_input_is_one_line_and_leaves_no_file(tmp_path, monkeypatch, error) -> None:
    monkeypatch.chdir(tmp_path)
    cases = [
        (("--video",), "--video: does not go with --serve"),
        (("--realtime",), "--realtime: does not go with --serve"),
        (("--robot-file", "mine.txt"), "--robot-file: mine.txt is not allowed; allowed is a file that ends"),
        (("--robot-file", "no/mine.yaml"), "no/mine.yaml: cannot be written: No such file or directory"),
        (("--robot", "bonbot"), "did you mean 'bonnbot'"),
        (("--port", "65535"), "--port"),
    ]
    for options, said in cases:
        assert refused(*options) == 2
        assert said in error()
    assert not list(tmp_path.iterdir())


def test_a_port_that_is_taken_is_one_line(tmp_path, monkeypatch, error) -> None:
    monkeypatch.chdir(tmp_path)
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]

        assert refused("--port", str(port)) == 2

    assert f"--port: {port} cannot be listened at: Address already in use" in error()
    assert not list(tmp_path.iterdir())
