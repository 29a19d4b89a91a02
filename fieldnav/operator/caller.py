"""The operator's end of the line: the missions that run, and one question put to one of them."""

import os
import socket
from contextlib import suppress
from pathlib import Path

from fieldnav.errors import FieldnavError
from fieldnav.operator.doorway import answers
from fieldnav.operator.request import Answer, Command
from fieldnav.operator.socket_place import SUFFIX, SocketPlace
from fieldnav.operator.wire import END, LONGEST_ANSWER_BYTES, read_answer, request_line

ANSWER_S = 5.0
"""A mission answers within a round of 20 ms; one that takes longer than both its patiences hangs."""


def running(place: SocketPlace) -> list[Path]:
    """The sockets of the user's running missions, newest first: their names begin with the time.

    Raises FieldnavError when there is none and a folder cannot be trusted to have shown all.
    """
    complaints = [complaint for folder in place.folders if (complaint := place.complaint(folder))]
    sound = [folder for folder in place.folders if not place.complaint(folder)]
    sockets = [path for folder in sound for path in folder.glob(f"*{SUFFIX}") if _alive(path)]
    if complaints and not sockets:
        raise FieldnavError(complaints[0])
    return sorted(sockets, key=lambda path: path.name, reverse=True)


def ask(path: Path, command: Command) -> Answer:
    """Put one question to a mission. Raises FieldnavError when no answer can be had."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as line:
        line.settimeout(ANSWER_S)
        try:
            line.connect(os.fspath(path))
            with suppress(BrokenPipeError, ConnectionResetError):  # it says why, and that can still be read
                line.sendall(request_line(command))
            said = _receive(line)
        except (BlockingIOError, TimeoutError) as error:
            raise FieldnavError(
                f"{path.stem}: gives no answer within {ANSWER_S:.0f} s; it may hang: use the emergency stop"
            ) from error
        except OSError as error:
            raise FieldnavError(f"{path.stem}: cannot be reached: {error.strerror or error}") from error
    if not said:
        raise FieldnavError(f"{path.stem}: has ended without an answer")
    return read_answer(said)


def _receive(line: socket.socket) -> bytes:
    """The answer's line, or what there was of it when the mission hung up."""
    said = b""
    with suppress(ConnectionResetError):
        while END not in said and len(said) < LONGEST_ANSWER_BYTES:
            chunk = line.recv(LONGEST_ANSWER_BYTES)
            if not chunk:
                break
            said += chunk
    return said.partition(END)[0]


def _alive(path: Path) -> bool:
    try:
        return answers(path)
    except OSError:  # no socket at all, or not for us
        return False
