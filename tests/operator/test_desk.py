"""The desk answers who may ask, and nothing that comes in holds the mission up or breaks it."""

import os
import socket
import stat
import time
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fieldnav.errors import OutputError
from fieldnav.operator.desk import MOST_CLIENTS, Desk
from fieldnav.operator.peer import Peer
from fieldnav.operator.request import Command
from fieldnav.operator.socket_place import SocketPlace, socket_path
from fieldnav.operator.status import Status
from fieldnav.operator.wire import LONGEST_REQUEST_BYTES

RUN = "20260501T083000Z-bonnbot"
QUIET_ROUNDS = 5000
QUIET_LIMIT_S = 50e-6
"""A looser bound than the few microseconds it takes, for a busy machine."""


class Caller(Protocol):
    def send(self, data: bytes) -> None: ...
    def heard(self) -> dict[str, object]: ...


Call = Callable[[], Caller]


def line(command: Command) -> bytes:
    return f'{{"command": "{command.value}"}}\n'.encode()


@pytest.mark.parametrize("command", Command)
def test_a_request_comes_in_the_round_it_is_made_and_is_answered_once(
    command: Command, desk: Desk, call: Call
) -> None:
    caller = call()
    caller.send(line(command))

    (request,) = desk.poll(0.0)
    request.reply(ok=True, said="done")
    request.reply(ok=False, said="a second word")

    assert request.command is command
    assert request.who == f"process {os.getpid()}"
    assert caller.heard() == {"ok": True, "said": "done", "status": None}
    assert desk.poll(0.02) == ()


def test_the_status_goes_out_with_the_answer(desk: Desk, call: Call) -> None:
    status = Status(RUN, "Forward.Exit", 1.5, 2, 3, 3, 20.5, 0.5, warnings=("rear camera knocked",))
    caller = call()
    caller.send(line(Command.STATUS))

    desk.poll(0.0)[0].reply(ok=True, said="", status=status)

    said = caller.heard()["status"]
    assert isinstance(said, dict)
    assert (said["state"], said["lane"], said["battery_percent"]) == ("Forward.Exit", 2, None)
    assert said["warnings"] == ["rear camera knocked"]


def test_a_line_that_comes_in_pieces_is_put_together(desk: Desk, call: Call) -> None:
    caller = call()
    whole = line(Command.PAUSE)
    caller.send(whole[:7])
    assert desk.poll(0.0) == ()
    caller.send(whole[7:])
    (request,) = desk.poll(0.02)
    assert request.command is Command.PAUSE


def test_a_quiet_desk_costs_microseconds(desk: Desk) -> None:
    started = time.process_time()
    for tick in range(QUIET_ROUNDS):
        desk.poll(tick * 0.02)
    assert (time.process_time() - started) / QUIET_ROUNDS < QUIET_LIMIT_S


def test_silent_callers_are_sent_away_and_make_room(desk: Desk, call: Call) -> None:
    silent = [call() for _ in range(MOST_CLIENTS)]
    desk.poll(0.0)
    one_too_many = call()
    desk.poll(0.02)
    assert "others speak to this mission" in str(one_too_many.heard()["said"])

    desk.poll(2.03)
    later = call()
    later.send(line(Command.STOP))

    assert [request.command for request in desk.poll(2.05)] == [Command.STOP]
    assert all(caller.heard()["said"] == "no whole line came within 2 s" for caller in silent)


def test_many_who_ask_at_once_are_all_heard(desk: Desk, call: Call) -> None:
    for _ in range(MOST_CLIENTS):
        call().send(line(Command.STATUS))
    assert len(desk.poll(0.0)) == MOST_CLIENTS


def test_an_answered_caller_leaves_its_room_to_the_next(desk: Desk, call: Call) -> None:
    for _ in range(3 * MOST_CLIENTS):
        caller = call()
        caller.send(line(Command.STATUS))
        desk.poll(0.0)[0].reply(ok=True, said="well")
        assert caller.heard()["ok"] is True


def test_a_mission_that_does_not_answer_says_so_in_the_end(desk: Desk, call: Call) -> None:
    caller = call()
    caller.send(line(Command.PAUSE))
    (request,) = desk.poll(0.0)
    desk.poll(2.1)
    request.reply(ok=True, said="too late")
    assert caller.heard()["said"] == "the mission gave no answer within 2 s"


def test_an_endless_line_is_cut_off(desk: Desk, call: Call) -> None:
    caller = call()
    caller.send(b" " * (LONGEST_REQUEST_BYTES + 1))
    assert desk.poll(0.0) == ()
    assert caller.heard()["said"] == f"line too long; allowed are {LONGEST_REQUEST_BYTES} bytes"


def test_the_longest_line_is_still_read(desk: Desk, call: Call) -> None:
    caller = call()
    caller.send(line(Command.PAUSE).strip().rjust(LONGEST_REQUEST_BYTES) + b"\n")
    assert [request.command for request in desk.poll(0.0)] == [Command.PAUSE]


def test_a_second_line_on_one_connection_is_refused_with_the_first(desk: Desk, call: Call) -> None:
    caller = call()
    caller.send(line(Command.PAUSE) + line(Command.RESUME))
    assert desk.poll(0.0) == ()
    assert "more than one line" in str(caller.heard()["said"])


@settings(
    max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)  # one desk takes all of it in, as it must
@given(
    st.one_of(
        st.binary(max_size=3000),
        st.text(max_size=300).map(lambda text: text.encode() + b"\n"),
        st.sampled_from([b'{"command": 1}\n', b'{"command": "fly"}\n', b"[" * 900 + b"\n", b'"\\ud800"\n']),
        st.dictionaries(st.text(max_size=9), st.text(max_size=9)).map(lambda d: f"{d}\n".encode()),
    )
)
def test_garbage_is_answered_with_an_error_and_breaks_nothing(desk: Desk, call: Call, garbage: bytes) -> None:
    caller = call()
    caller.send(garbage)

    assert desk.poll(0.0) == ()
    desk.poll(2.1)

    assert caller.heard()["ok"] is False
    assert desk.poll(2.12) == ()


def test_a_caller_who_hangs_up_before_the_answer_does_not_matter(desk: Desk, place: SocketPlace) -> None:
    caller = _connected(place)
    caller.sendall(line(Command.STOP))
    caller.close()
    (request,) = desk.poll(0.0)
    request.reply(ok=True, said="stopping")
    assert request.command is Command.STOP


def test_another_user_is_refused(place: SocketPlace, call: Call) -> None:
    other = os.getuid() + 1
    with Desk.open(RUN, place, peer_of=lambda connection: Peer(77, other)) as desk:
        caller = call()
        caller.send(line(Command.STOP))
        assert desk.poll(0.0) == ()
        assert caller.heard()["said"] == (
            f"user {other} may not speak to this mission; allowed is user {os.getuid()}"
        )


def test_a_peer_whom_the_kernel_does_not_know_is_hung_up_on(place: SocketPlace, call: Call) -> None:
    def unknown(connection: object) -> Peer:
        raise OSError("no credentials")

    with Desk.open(RUN, place, peer_of=unknown) as desk:
        call().send(line(Command.STOP))
        assert desk.poll(0.0) == ()


def test_the_socket_is_for_its_user_alone(desk: Desk, place: SocketPlace) -> None:
    folder = place.folders[0]
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert stat.S_IMODE(socket_path(folder, RUN).stat().st_mode) == 0o600


def test_closing_tells_who_waits_and_removes_the_socket(desk: Desk, call: Call, place: SocketPlace) -> None:
    caller = call()
    desk.poll(0.0)
    desk.close()
    desk.close()
    assert caller.heard()["said"] == "the mission has ended"
    assert list(place.folders[0].iterdir()) == []
    assert desk.poll(0.02) == ()


def test_the_socket_of_a_dead_process_is_replaced(place: SocketPlace, call: Call) -> None:
    _left_behind(socket_path(place.make(), RUN))
    with Desk.open(RUN, place) as desk:
        call().send(line(Command.PAUSE))
        assert len(desk.poll(0.0)) == 1


def test_the_socket_of_a_live_mission_is_not_replaced(desk: Desk, place: SocketPlace, call: Call) -> None:
    with pytest.raises(OutputError, match="another process drives this run"):
        Desk.open(RUN, place)
    call().send(line(Command.PAUSE))
    assert len(desk.poll(0.0)) == 1


def test_a_live_mission_whose_callers_queue_is_full_is_not_replaced(desk: Desk, place: SocketPlace) -> None:
    waiting = [_connected(place) for _ in range(17)]  # the backlog of 16, and one more that the kernel takes
    with pytest.raises(OutputError, match="another process drives this run"):
        Desk.open(RUN, place)
    for connection in waiting:
        connection.close()


def test_a_file_that_is_no_socket_is_left_alone(place: SocketPlace) -> None:
    path = socket_path(place.make(), RUN)
    path.write_text("mine")
    with pytest.raises(OutputError, match="is no socket; remove it"):
        Desk.open(RUN, place)
    assert path.read_text() == "mine"


def test_a_mission_that_ends_late_leaves_its_successors_socket_alone(place: SocketPlace, call: Call) -> None:
    first = Desk.open(RUN, place)
    socket_path(place.folders[0], RUN).unlink()
    with Desk.open(RUN, place) as second:
        first.close()
        call().send(line(Command.PAUSE))
        assert len(second.poll(0.0)) == 1


def _connected(place: SocketPlace) -> socket.socket:
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    connection.connect(os.fspath(socket_path(place.folders[0], RUN)))
    return connection


def _left_behind(path: Path) -> None:
    """A socket's file without a process, as a kill leaves it."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as dead:
        dead.bind(os.fspath(path))
