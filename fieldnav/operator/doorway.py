"""A listening local socket in the file system: made over a dead one's file, never over a live one's."""

import os
import socket
import stat
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from fieldnav.errors import OutputError
from fieldnav.journal.files import PRIVATE_FILE, alone_in

BACKLOG = 16
"""Callers that may wait between two rounds of the loop."""
PROBE_S = 0.5
"""A live process's socket takes a caller at once, unless its backlog is full."""


def answers(path: Path) -> bool:
    """Whether a live process listens at a socket; one too busy to take a caller is alive."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as probe:
        probe.settimeout(PROBE_S)
        try:
            probe.connect(os.fspath(path))
        except (ConnectionRefusedError, FileNotFoundError):
            return False
        except (BlockingIOError, TimeoutError):
            return True
        return True


@dataclass(frozen=True, slots=True)
class Doorway:
    """A listener that does not block, and the file it lies at."""

    listener: socket.socket
    path: Path
    file: tuple[int, int]
    """Device and inode, to know the file again."""

    @classmethod
    def make(cls, path: Path) -> Self:
        """Listen at `path`, for this user alone. Raises OutputError, also where a live process does."""
        listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            listener.setblocking(False)
            with alone_in(path.parent):  # other missions neither clear nor make a socket
                _clear(path)
                listener.bind(os.fspath(path))
                path.chmod(PRIVATE_FILE)
                listener.listen(BACKLOG)
            return cls(listener, path, _file(path))
        except OutputError:
            listener.close()
            raise
        except OSError as error:
            listener.close()
            raise OutputError(f"{path}: no socket can be made here: {error.strerror or error}") from error

    def close(self) -> None:
        """Listen no longer and remove the file, unless another has taken its place; may be repeated."""
        self.listener.close()
        with suppress(OSError):
            if _file(self.path) == self.file:
                self.path.unlink()


def _clear(path: Path) -> None:
    """Remove what a dead process has left."""
    try:
        found = path.lstat()
    except FileNotFoundError:
        return
    if not stat.S_ISSOCK(found.st_mode):
        raise OutputError(f"{path}: is no socket; remove it, the mission's socket belongs there")
    if answers(path):
        raise OutputError(f"{path}: another process drives this run; stop it first: fieldnav ctl stop")
    path.unlink()


def _file(path: Path) -> tuple[int, int]:
    found = path.lstat()
    return found.st_dev, found.st_ino
