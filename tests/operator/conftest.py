"""A folder for sockets, and a caller at a desk that is looked at round by round."""

import json
import os
import socket
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from fieldnav.operator.desk import Desk
from fieldnav.operator.socket_place import SocketPlace, socket_path

RUN = "20260501T083000Z-bonnbot"


class Caller:
    """A connection to a run's desk, in the hands of a test."""

    def __init__(self, path: Path) -> None:
        self.line = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.line.settimeout(5.0)
        self.line.connect(os.fspath(path))

    def send(self, data: bytes) -> None:
        self.line.sendall(data)

    def heard(self) -> dict[str, Any]:
        """The one line of the answer, after which the desk hangs up."""
        said = b""
        try:
            while chunk := self.line.recv(1 << 16):
                said += chunk
        except ConnectionResetError:  # it hung up on what it had not read
            pass
        assert said.endswith(b"\n") and said.count(b"\n") == 1, said
        answer = json.loads(said)
        assert isinstance(answer, dict)
        return answer


@pytest.fixture
def place() -> Iterator[SocketPlace]:
    """A user's runtime folder; short, as paths of sockets must be."""
    with tempfile.TemporaryDirectory(prefix="fn") as folder:
        runtime = Path(folder) / "runtime"
        runtime.mkdir(mode=0o700)
        yield SocketPlace(os.getuid(), Path(folder), {"XDG_RUNTIME_DIR": str(runtime)})


@pytest.fixture
def desk(place: SocketPlace) -> Iterator[Desk]:
    with Desk.open(RUN, place) as desk:
        yield desk


@pytest.fixture
def call(place: SocketPlace) -> Iterator[Callable[[], Caller]]:
    """Connects another caller; all of them hang up at the end."""
    callers: list[Caller] = []

    def connect() -> Caller:
        callers.append(Caller(socket_path(place.folders[0], RUN)))
        return callers[-1]

    yield connect
    for caller in callers:
        caller.line.close()
