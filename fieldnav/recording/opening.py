"""A file of a recording opened: by its own index, or by what a survey finds, with its end then mended."""

import errno
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from io import SEEK_END
from pathlib import Path
from typing import BinaryIO

from mcap.summary import Summary
from mcap.writer import MCAP0_MAGIC

from fieldnav.errors import FieldnavError
from fieldnav.recording.chunk_walk import Entries
from fieldnav.recording.ending import read_summary
from fieldnav.recording.mending import alone, mend
from fieldnav.recording.survey import survey
from fieldnav.recording.walk import read_at

BLOCK_BYTES = 4096
"""Read at once: heads of records and small messages, not the picture beside them."""

MOST_TORN_BYTES = 1 << 26
"""What a power loss can tear off the end, several seconds of writing; more is damage, and is not cut off."""

Reading = Callable[[Path], BinaryIO]
"""Opens a file to be read. Raises OSError."""


@dataclass(frozen=True, slots=True)
class Opened:
    """A file with the summary of what is in it; last: the last chunk's messages, if its index lacks."""

    file: BinaryIO
    summary: Summary
    last: Entries = field(default_factory=dict)


def existing_file(path: Path) -> BinaryIO:
    """A file to be read by small blocks. Raises OSError, also for a pipe, at which it would wait for ever."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise OSError(errno.EINVAL, "is no file on a disk", str(path))
    return path.open("rb", buffering=BLOCK_BYTES)


def opened(path: Path, reading: Reading) -> Opened:
    """Open a piece; one that broke off gets its end, unless it is being written, damaged, or cannot be.

    Raises OSError, and FieldnavError for what is no MCAP file.
    """
    file = reading(path)
    try:
        begin = read_at(file, 0, len(MCAP0_MAGIC))
        if begin != MCAP0_MAGIC[: len(begin)]:
            raise FieldnavError(f"{path}: is no recording; allowed is an MCAP file")
        summary = read_summary(file)
        return Opened(file, summary) if summary else _mended(path, file, reading)
    except BaseException:
        file.close()
        raise


def _mended(path: Path, file: BinaryIO, reading: Reading) -> Opened:
    with alone(file) as free:
        if free:
            with reading(path) as fresh:
                summary = read_summary(fresh)
            if summary is not None:  # somebody else has mended it meanwhile
                return Opened(file, summary)
        found = survey(file)
        if free and file.seek(0, SEEK_END) - found.whole_to <= MOST_TORN_BYTES:
            with suppress(OSError):  # it is read all the same
                mend(path, found)
        return Opened(file, found.summary, found.last)
