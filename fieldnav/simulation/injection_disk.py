"""A disk that is full but for what a file gives back: a raw file whose writes fail as on a real one."""

import errno
import os
from collections.abc import Callable
from io import FileIO
from typing import IO, Any


class FullDisk:
    """In place of an open file: takes nothing while there is no room, and passes everything else on."""

    def __init__(self, file: IO[bytes] | FileIO, room: Callable[[], bool]) -> None:
        self._file, self._room = file, room

    def write(self, content: bytes) -> int:
        """Raises OSError as a full disk does."""
        if not self._room():
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return self._file.write(content)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._file, name)
