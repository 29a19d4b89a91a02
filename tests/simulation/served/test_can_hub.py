"""The served bus at its sockets: who hears whom, what is refused, and who may be slow."""

import socket
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack

import can
import pytest

from fieldnav.errors import SettingsError
from fieldnav.simulation.served.can_hub import MOST_CLIENTS, CanHub

LIMIT_S = 20.0

Client = Callable[[tuple[str, int]], can.BusABC]
Heard = Callable[[can.BusABC, int], can.Message]


@pytest.fixture
def connect(attended: CanHub) -> Iterator[Callable[[], socket.socket]]:
    """Bare connections, greeted."""
    with ExitStack() as stack:

        def open_one() -> socket.socket:
            connection = stack.enter_context(socket.create_connection(attended.address, timeout=LIMIT_S))
            assert connection.recv(100) == b"< hi >"
            return connection

        yield open_one


def is_closed(connection: socket.socket) -> bool:
    """Reads on to the end; only a connection that the other side has closed has one."""
    try:
        while connection.recv(1 << 16):
            pass
    except ConnectionResetError:
        pass
    return True


def frame(identifier: int, *data: int) -> can.Message:
    return can.Message(arbitration_id=identifier, data=data, is_extended_id=False)


def test_two_clients_hear_each_other_and_nobody_hears_itself(
    attended: CanHub, client: Client, heard: Heard
) -> None:
    one, other = client(attended.address), client(attended.address)

    one.send(frame(0x101, 1, 2))
    told = heard(other, 0x101)
    other.send(frame(0x102))
    answer = one.recv(timeout=LIMIT_S)

    assert bytes(told.data) == b"\x01\x02"
    assert answer is not None and answer.arbitration_id == 0x102 and answer.dlc == 0
    assert [taken.arbitration_id for taken in attended.arrived] == [0x101, 0x102]


def test_a_frame_carries_the_time_of_day(attended: CanHub, client: Client, heard: Heard) -> None:
    one, other = client(attended.address), client(attended.address)
    before_s = time.time()

    one.send(frame(0x101))

    assert before_s - 0.01 <= heard(other, 0x101).timestamp <= time.time() + 0.01


def test_a_client_that_only_listens_is_told_too(attended: CanHub, client: Client, heard: Heard) -> None:
    speaker, listener = client(attended.address), client(attended.address)

    speaker.send(frame(0x101))

    assert heard(listener, 0x101)


@pytest.mark.parametrize(
    "text",
    [
        b"GET /front.mjpg HTTP/1.1\r\n\r\n",
        b"\xff\xff\xff\xff",
        b"< open vcan7 >",
        b"< rawmode >",
        b"< open can0 >< send 201 0 >",
        b"< open can0 >< rawmode >< send 201 8 1 2 3 >",
        b"< open can0 >< rawmode >< bcmmode >",
        b"<" + b"a" * 5000,
    ],
)
def test_garbage_is_refused_and_the_bus_goes_on(
    text: bytes, attended: CanHub, connect: Callable[[], socket.socket], client: Client, heard: Heard
) -> None:
    one, other = client(attended.address), client(attended.address)
    stranger = connect()

    stranger.sendall(text)

    assert is_closed(stranger)
    one.send(frame(0x101))
    assert heard(other, 0x101)
    assert [taken.arbitration_id for taken in attended.arrived] == [0x101]


def test_a_refused_client_is_told_why(attended: CanHub, connect: Callable[[], socket.socket]) -> None:
    stranger = connect()

    stranger.sendall(b"< open vcan7 >")

    assert stranger.recv(100) == b"< error expected open can0 >"


def test_more_clients_than_a_bus_has_room_for_are_left(
    attended: CanHub, connect: Callable[[], socket.socket]
) -> None:
    for _ in range(MOST_CLIENTS):
        connect()

    with socket.create_connection(attended.address, timeout=LIMIT_S) as one_more:
        assert is_closed(one_more)


def test_a_client_that_has_left_makes_room(attended: CanHub, connect: Callable[[], socket.socket]) -> None:
    clients = [connect() for _ in range(MOST_CLIENTS)]

    for gone in clients:
        gone.sendall(b"< nonsense >")
        assert is_closed(gone)

    assert connect()


def test_the_bus_is_on_loopback_alone(attended: CanHub) -> None:
    assert attended.address[0] == "127.0.0.1"


def test_a_port_that_is_taken_is_one_clear_line(attended: CanHub) -> None:
    _, port = attended.address

    with pytest.raises(SettingsError, match=f"^--port: {port} cannot be listened at: .*free port, or 0$"):
        CanHub(port, "can0", lambda: 0.0, 0.0)
