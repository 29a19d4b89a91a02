"""Writing a whole file or none of it, and whole lines or none of them; for their owner alone to read."""

import errno
import fcntl
import os
import stat
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from io import FileIO
from pathlib import Path

from fieldnav.errors import OutputError

PRIVATE_FOLDER, PRIVATE_FILE = 0o700, 0o600
"""A run's settings hold the passwords of its cameras, and its pictures what they saw."""


def private(path: str, flags: int) -> int:
    """Opens a file that only its owner may read, whatever the umask; for `opener` of open()."""
    return os.open(path, flags, PRIVATE_FILE)


def check_replaceable(path: Path) -> None:
    """Raises OutputError for what is neither a regular file, which may be replaced, nor a name still free."""
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        return
    except OSError as error:
        raise unwritable(path, error) from error
    if not stat.S_ISREG(mode):
        kinds = ((stat.S_ISDIR, "a folder"), (stat.S_ISLNK, "a link"))
        kind = next((name for is_kind, name in kinds if is_kind(mode)), "a pipe or a device")
        allowed = "allowed is a new name, or a regular file to replace"
        raise OutputError(f"{path}: cannot be written: is {kind}; {allowed}")


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Where to write it: a file beside its place, which it takes once it is whole. Raises OutputError."""
    check_replaceable(path)
    try:
        number, name = tempfile.mkstemp(prefix=".part-", suffix=path.suffix, dir=path.parent)
        os.close(number)
    except OSError as error:
        raise OutputError(
            f"{unwritable(path, error)}; allowed is a file in a folder you can write"
        ) from error
    beside = Path(name)
    try:
        yield beside
        beside.replace(path)
    except OSError as error:
        raise unwritable(path, error) from error
    finally:
        beside.unlink(missing_ok=True)


def write_atomically(path: Path, content: bytes) -> None:
    """Write beside the file, sync, rename over it. Raises OutputError; the old file then still stands."""
    with whole_file(path) as beside, beside.open("wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Keep out other processes that do the same in this folder. Raises OSError."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def append_line(file: FileIO, line: bytes, sync: Callable[[], None]) -> None:
    """Append a line to an unbuffered file and sync it. Raises OSError; the file then ends as before.

    A file that was deleted takes lines as before, but nobody can read them any more: it is an error too.
    """
    if os.fstat(file.fileno()).st_nlink == 0:
        raise OSError(errno.ENOENT, "it was deleted")
    content, whole_lines = line + b"\n", file.seek(0, os.SEEK_END)
    try:
        while content:
            content = content[file.write(content) :]
        sync()
    except OSError:
        with suppress(OSError):  # the disk is failing already; a torn line would hide the ones after it
            file.truncate(whole_lines)
        raise


@contextmanager
def first_failure_told() -> Iterator[None]:
    """For what is written at the end of a run: where the run has failed, that it cannot be is not told."""
    failed = sys.exception() is not None
    try:
        yield
    except OutputError:
        if not failed:
            raise


def unwritable(path: Path, error: OSError) -> OutputError:
    """The error of a file that cannot be written, in one line."""
    return OutputError(f"{path}: cannot be written: {error.strerror}")
