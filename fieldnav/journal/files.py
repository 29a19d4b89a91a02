"""Writing a whole file or none of it, and whole lines or none of them."""

import errno
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from io import FileIO
from pathlib import Path

from fieldnav.errors import OutputError


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Where to write it: beside its place, which it takes once it is whole. Raises OutputError."""
    beside = path.with_name(f".{path.name}.part")
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
