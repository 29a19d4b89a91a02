"""A file that broke off gets its end: whole messages stay where they are, what is torn after them goes."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from mcap.opcode import Opcode
from mcap.records import Header, MessageIndex
from mcap.writer import MCAP0_MAGIC

from fieldnav import __version__
from fieldnav.recording.ending import ending, packed
from fieldnav.recording.survey import Survey
from fieldnav.recording.walk import CHUNK_HEAD, HEAD, LENGTH

NO_CHECKSUM = 0
"""Of the last chunk: that of a torn one says nothing any more."""


def mend(path: Path, found: Survey) -> None:
    """Write the file's end. Broken off at any byte of it, it can be done again. Raises OSError."""
    with path.open("r+b") as file:
        if found.torn:  # first, so that all the messages are within a whole chunk before anything follows
            index = found.summary.chunk_indexes[-1]
            file.seek(index.chunk_start_offset)
            file.write(_chunk_head(found))
            _sync(file)
        content = _tail(found)
        file.truncate(found.whole_to)
        file.seek(found.whole_to)
        file.write(content)
        _sync(file)


@contextmanager
def alone(file: BinaryIO) -> Iterator[bool]:
    """Whether nobody else writes or mends an open file; for as long as this lasts nobody can begin to."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        yield False
        return
    try:
        yield True
    finally:
        fcntl.flock(file, fcntl.LOCK_UN)


def _chunk_head(found: Survey) -> bytes:
    index = found.summary.chunk_indexes[-1]
    head = HEAD.pack(Opcode.CHUNK, index.chunk_length - HEAD.size)
    times = (index.message_start_time, index.message_end_time)
    head += CHUNK_HEAD.pack(*times, index.uncompressed_size, NO_CHECKSUM, 0)
    return head + LENGTH.pack(index.compressed_size)


def _tail(found: Survey) -> bytes:
    """All that follows what is whole; completes the summary by where the last chunk's indexes then lie."""
    content = b"" if found.whole_to else MCAP0_MAGIC + packed(Header("", f"fieldnav {__version__}"))
    for channel, entries in found.last.items():
        index = found.summary.chunk_indexes[-1]
        index.message_index_offsets[channel] = found.whole_to + len(content)
        content += packed(MessageIndex(channel, entries))
        index.message_index_length = len(content)
    return content + ending(found.summary, found.whole_to + len(content))


def _sync(file: BinaryIO) -> None:
    file.flush()
    os.fsync(file.fileno())
