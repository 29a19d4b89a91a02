"""Clients that do not read and those that never stop: neither holds up the bus nor fills the memory."""

import socket
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack

import can
import pytest

from fieldnav.simulation.served.can_client import MOST_WAITING, QUIET_S, READ_BYTES
from fieldnav.simulation.served.can_hub import CanHub
from fieldnav.simulation.served.can_text import FRAME_BYTES

STEP_S = 0.005
LIMIT_S = 20.0
BATCH = 500
SENT = b"< send 201 0 >"


@pytest.fixture
def connect(hub: CanHub) -> Iterator[Callable[[], socket.socket]]:
    """Connections that have shaken hands; the test's own thread attends the bus meanwhile."""
    with ExitStack() as stack:

        def answer(connection: socket.socket, expected: bytes) -> None:
            until_s, told = time.monotonic() + LIMIT_S, b""
            while told != expected and time.monotonic() < until_s:
                hub.attend(time.monotonic() + STEP_S)
                told += arrived(connection)
            assert told == expected

        def open_one() -> socket.socket:
            connection = stack.enter_context(socket.create_connection(hub.address))
            connection.setblocking(False)
            answer(connection, b"< hi >")
            connection.sendall(b"< open can0 >")
            answer(connection, b"< ok >")
            connection.sendall(b"< rawmode >")
            answer(connection, b"< ok >")
            return connection

        yield open_one


def arrived(connection: socket.socket) -> bytes:
    """What has come, without waiting."""
    try:
        return connection.recv(1 << 20)
    except BlockingIOError:
        return b""


def numbered(number: int) -> can.Message:
    return can.Message(arbitration_id=0x100, data=number.to_bytes(4, "big"), is_extended_id=False)


def numbers(texts: bytes) -> list[int]:
    """The numbers of the frames told; every one of them must be whole."""
    assert len(texts) % FRAME_BYTES == 0
    frames = [texts[at : at + FRAME_BYTES] for at in range(0, len(texts), FRAME_BYTES)]
    assert all(frame.endswith(b" >") and frame.lstrip().startswith(b"< frame 100 ") for frame in frames)
    return [int(frame.split()[-2], 16) for frame in frames]


def test_who_does_not_read_loses_the_oldest_frames_and_holds_nobody_up(
    hub: CanHub, connect: Callable[[], socket.socket]
) -> None:
    sleeper, reader = connect(), connect()
    # More than the sleeper's two sockets and its queue can hold.
    count = 4 * (MOST_WAITING + (1 << 20) // FRAME_BYTES) // BATCH * BATCH
    read = b""

    for first in range(0, count, BATCH):
        for number in range(first, first + BATCH):
            hub.pass_on(numbered(number))
        until_s = time.monotonic() + LIMIT_S
        while len(read) < (first + BATCH) * FRAME_BYTES and time.monotonic() < until_s:
            hub.attend(time.monotonic())
            read += arrived(reader)
    slept, until_s = b"", time.monotonic() + LIMIT_S
    while (not slept or numbers(slept[-FRAME_BYTES:]) != [count - 1]) and time.monotonic() < until_s:
        slept += arrived(sleeper)
        hub.attend(time.monotonic())

    assert numbers(read) == list(range(count)), "who reads is told everything, in order"
    told = numbers(slept)
    assert told == sorted(told) and told[-1] == count - 1 and len(told) < count / 2


def test_who_never_stops_sending_is_heard_a_bus_full_a_step(
    hub: CanHub, connect: Callable[[], socket.socket]
) -> None:
    flooder = connect()
    flooder.sendall(SENT * BATCH)

    heard = []
    while sum(heard) < BATCH:
        hub.attend(time.monotonic() + STEP_S)
        heard.append(len(hub.arrived))
        hub.arrived.clear()

    assert max(heard) <= -(-2 * READ_BYTES // len(SENT)), "no more than is read at once beyond the allowance"
    assert sum(heard) == BATCH


def test_a_frame_is_kept_back_until_the_handshakes_last_answer_has_been_read() -> None:
    now_s = [0.0]
    hub = CanHub(0, "can0", lambda: now_s[0], 0.0)
    with socket.create_connection(hub.address) as connection:
        connection.setblocking(False)
        connection.sendall(b"< open can0 >< rawmode >")
        told, until_s = b"", time.monotonic() + LIMIT_S
        while told != b"< hi >< ok >< ok >" and time.monotonic() < until_s:
            hub.attend(0.0)
            told += arrived(connection)
        hub.pass_on(numbered(7))
        hub.attend(0.0)
        at_once = arrived(connection)
        now_s[0] = QUIET_S
        while not told.endswith(b"00000007 >") and time.monotonic() < until_s:
            hub.attend(0.0)
            told += arrived(connection)
    hub.close()

    assert at_once == b"" and numbers(told.removeprefix(b"< hi >< ok >< ok >")) == [7]
