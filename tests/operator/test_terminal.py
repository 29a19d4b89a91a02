"""Keys on the mission's own terminal become requests, and the terminal is always given back as it was."""

import os
import pty
import signal
import socket
import subprocess
import sys
import termios
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from fieldnav.operator.terminal import TerminalKeys

CHILD = Path(__file__).with_name("keyboard_child.py")
LONGEST_S = 20.0
"""For a process to start on a busy machine; a bound, not an expectation."""
ROUNDS = 20
"""Looks that must find nothing."""


class Seat:
    """A person at a terminal, and the process that watches its keys."""

    def __init__(self) -> None:
        self.master, self.slave = pty.openpty()
        self.modes_before = termios.tcgetattr(self.slave)
        self._ours, theirs = socket.socketpair()
        self._ours.settimeout(LONGEST_S)
        self._control = self._ours.makefile("rw")
        self.process = subprocess.Popen(
            [sys.executable, str(CHILD), str(theirs.fileno())],
            stdin=self.slave,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            pass_fds=[theirs.fileno()],
            start_new_session=True,
        )
        theirs.close()

    def order(self, order: str) -> str:
        self._control.write(order + "\n")
        self._control.flush()
        answer = self._control.readline()
        assert answer, "the process goes on"
        return answer.strip()

    def press(self, keys: bytes) -> None:
        os.write(self.master, keys)

    def press_aloud(self, keys: bytes) -> None:
        """Press keys where the terminal shows them: what it has shown has come through it."""
        self.press(keys)
        shown = b""
        while b"\n" not in shown:
            shown += os.read(self.master, 100)

    def request(self) -> str:
        """The next request; a key takes a moment through the terminal."""
        until = time.monotonic() + LONGEST_S
        while not (found := self.order("poll")):
            assert time.monotonic() < until, "a request comes"
        return found

    def modes(self) -> list[object]:
        return termios.tcgetattr(self.slave)

    def set_modes(self, modes: list[int | list[bytes | int]]) -> None:
        termios.tcsetattr(self.slave, termios.TCSANOW, modes)

    def leave(self) -> None:
        self._control.close()
        self._ours.close()

    def close(self) -> None:
        self.leave()
        self.process.kill()
        self.process.wait()
        os.close(self.master)
        os.close(self.slave)


@pytest.fixture
def seat() -> Iterator[Seat]:
    seat = Seat()
    assert seat.order("poll") == ""  # takes the terminal over
    yield seat
    seat.close()


@pytest.mark.parametrize(
    ("keys", "command"),
    [
        (b"p", "pause"),
        (b"P", "pause"),
        (b"\r", "resume"),
        (b"q", "stop"),
        (b"q\r", "stop"),
        (b"\rp", "pause"),
        (b"xq\r", "stop"),
    ],
)
def test_a_key_makes_a_request_and_of_several_the_most_careful_one(
    seat: Seat, keys: bytes, command: str
) -> None:
    seat.press(keys)
    assert seat.request() == command
    assert seat.order("said") == f"heard {command}"
    assert seat.order("poll") == ""


@pytest.mark.parametrize("keys", [b"\x1bOq", b"\x1b[15~p", b"x y z", b"\x04"])
def test_other_keys_ask_for_nothing(seat: Seat, keys: bytes) -> None:
    seat.press(keys)
    assert [seat.order("poll") for _ in range(ROUNDS)] == [""] * ROUNDS
    seat.press(b"p")
    assert seat.request() == "pause"


def test_a_terminal_that_gathers_keys_does_not_hold_up_the_mission() -> None:
    seat = Seat()
    try:
        seat.modes_before[6][termios.VMIN] = b"\x0a"
        seat.set_modes(seat.modes_before)
        assert seat.order("poll") == ""
        seat.press(b"p")
        assert seat.request() == "pause"
    finally:
        seat.close()


def test_what_was_typed_before_the_mission_watches_is_thrown_away() -> None:
    seat = Seat()
    try:
        seat.press_aloud(b"q\n")
        assert seat.order("poll") == ""
        seat.press(b"p")
        assert seat.request() == "pause"
    finally:
        seat.close()


def test_keys_are_not_shown_and_the_terminal_cannot_be_held_up_but_interrupted(seat: Seat) -> None:
    modes = termios.tcgetattr(seat.slave)
    assert not modes[3] & (termios.ICANON | termios.ECHO)
    assert not modes[0] & termios.IXON
    assert modes[3] & termios.ISIG


def test_the_terminal_is_given_back_at_the_end(seat: Seat) -> None:
    assert seat.modes() != seat.modes_before
    seat.leave()
    assert seat.process.wait(LONGEST_S) == 0
    assert seat.modes() == seat.modes_before


def test_the_terminal_is_given_back_after_an_error(seat: Seat) -> None:
    with pytest.raises(AssertionError, match="goes on"):
        seat.order("fail")
    assert seat.process.wait(LONGEST_S) == 1
    assert seat.modes() == seat.modes_before


@pytest.mark.parametrize("asked", [signal.SIGINT, signal.SIGTERM])
def test_the_terminal_is_given_back_when_the_process_is_told_to_end(
    seat: Seat, asked: signal.Signals
) -> None:
    seat.process.send_signal(asked)
    assert seat.process.wait(LONGEST_S) != 0
    assert seat.modes() == seat.modes_before


def test_in_the_background_keys_are_left_to_the_shell_and_nothing_stops_the_mission(seat: Seat) -> None:
    shell = int(seat.order("back"))
    seat.set_modes(seat.modes_before)  # as a shell does when it has the terminal again
    seat.press_aloud(b"q\n")
    assert [seat.order("poll") for _ in range(ROUNDS)] == [""] * ROUNDS
    assert seat.modes() == seat.modes_before
    os.kill(shell, signal.SIGKILL)


def test_brought_to_the_front_again_it_obeys_only_what_is_typed_from_then_on(seat: Seat) -> None:
    shell = int(seat.order("back"))
    seat.set_modes(seat.modes_before)
    seat.press_aloud(b"q\n")
    seat.order("front")
    assert [seat.order("poll") for _ in range(ROUNDS)] == [""] * ROUNDS
    seat.press(b"p")
    assert seat.request() == "pause"
    os.kill(shell, signal.SIGKILL)


def test_ended_in_the_background_it_leaves_the_shells_terminal_alone(seat: Seat) -> None:
    shell = int(seat.order("back"))
    theirs = termios.tcgetattr(seat.slave)
    seat.leave()
    assert seat.process.wait(LONGEST_S) == 0
    assert seat.modes() == theirs
    os.kill(shell, signal.SIGKILL)


def test_a_lost_terminal_ends_the_watching_and_not_the_mission() -> None:
    ours, theirs = pty.openpty()
    with TerminalKeys(print, theirs) as keys:
        os.close(ours)
        assert keys.poll(0.0) == ()
    os.close(theirs)


def test_without_a_terminal_there_are_no_keys(tmp_path: Path) -> None:
    typed = tmp_path / "typed"
    typed.write_bytes(b"q")
    with typed.open("rb") as file, TerminalKeys(print, file.fileno()) as keys:
        assert not keys.here
        assert keys.poll(0.0) == ()


def test_a_terminal_of_another_session_is_left_alone() -> None:
    ours, theirs = pty.openpty()
    before = termios.tcgetattr(theirs)
    with TerminalKeys(print, theirs) as keys:
        os.write(ours, b"q\n")
        assert [keys.poll(0.0) for _ in range(ROUNDS)] == [()] * ROUNDS
        assert termios.tcgetattr(theirs) == before
    os.close(ours)
    os.close(theirs)
