"""Whether a file of a recording is as it was written: its checksums, and its indexes against its messages."""

import zlib
from io import SEEK_END, BytesIO
from pathlib import Path
from typing import BinaryIO

from mcap.opcode import Opcode
from mcap.records import Channel, ChunkIndex, DataEnd, MessageIndex

from fieldnav.errors import FieldnavError
from fieldnav.recording.chunk_walk import Entries, walk_chunk
from fieldnav.recording.ending import END_BYTES, FOOTER, packed, read_summary
from fieldnav.recording.opening import Opened
from fieldnav.recording.walk import CHUNK_HEAD, HEAD, LENGTH, read_at

DATA_END_BYTES = len(packed(DataEnd(0)))


def check_sound(path: Path, opened: Opened) -> None:
    """Read all of an opened file. Raises FieldnavError, with the place, for what is not as it was written.

    A file that broke off has no checksum of the whole any more, and its last chunk none of its own.
    """
    chunks = opened.summary.chunk_indexes[:-1] if opened.last else opened.summary.chunk_indexes
    at, checksum = 0, 0
    try:
        for index in chunks:
            checksum = zlib.crc32(_bytes(opened.file, at, index.chunk_start_offset), checksum)
            at = index.chunk_start_offset + index.chunk_length + index.message_index_length
            content = _bytes(opened.file, index.chunk_start_offset, at)
            checksum = zlib.crc32(content, checksum)
            _check_chunk(content, index, opened.summary.channels)
        if read_summary(opened.file) is not None:
            _check_end(opened.file, at, checksum)
    except _DamageError as error:
        said = f"{path}: is damaged: {error}; allowed is a recording as it was written"
        raise FieldnavError(said) from error
    except OSError as error:
        raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error


class _DamageError(Exception):
    """What is damaged, and where."""


def _bytes(file: BinaryIO, begin: int, end: int) -> bytes:
    content = read_at(file, begin, end - begin) if end > begin else b""
    if begin + len(content) != end:
        raise _DamageError(f"what should lie from byte {begin} to {end} does not")
    return content


def _check_chunk(content: bytes, index: ChunkIndex, known: dict[int, Channel]) -> None:
    """The chunk and the message indexes behind it, against each other and against the index at the end."""
    place = f"the chunk at byte {index.chunk_start_offset}"
    data_at = HEAD.size + CHUNK_HEAD.size + LENGTH.size
    if len(content) < data_at or index.compression:
        raise _DamageError(f"{place} is none of fieldnav's")
    begin_ns, end_ns, size, checksum, name_length = CHUNK_HEAD.unpack_from(content, HEAD.size)
    data = content[data_at : index.chunk_length]
    (length,) = LENGTH.unpack_from(content, data_at - LENGTH.size)
    told = (*HEAD.unpack_from(content), name_length, size, length)
    if told != (Opcode.CHUNK, index.chunk_length - HEAD.size, 0, len(data), len(data)):
        raise _DamageError(f"the head of {place} does not fit what follows")
    if checksum and zlib.crc32(data) != checksum:
        raise _DamageError(f"{place} does not fit its checksum")
    walked = walk_chunk(BytesIO(data), 0, len(data), known)
    if walked.length != len(data):
        raise _DamageError(f"a record in {place} is none")
    if not walked.span_ns == (begin_ns, end_ns) == (index.message_start_time, index.message_end_time):
        raise _DamageError(f"{place} has other times than its messages")
    if not _indexes_fit(content, index, walked.entries):
        raise _DamageError(f"the message indexes of {place} do not fit its messages")


def _indexes_fit(content: bytes, index: ChunkIndex, entries: Entries) -> bool:
    """Whether the message indexes behind a chunk, and no others, tell of its messages."""
    wanted = {channel: packed(MessageIndex(channel, each)) for channel, each in entries.items()}
    places = index.message_index_offsets
    if wanted.keys() != places.keys() or sum(map(len, wanted.values())) != index.message_index_length:
        return False
    return all(content.startswith(wanted[each], places[each] - index.chunk_start_offset) for each in places)


def _check_end(file: BinaryIO, at: int, checksum: int) -> None:
    """What lies between the last chunk and the summary; checksum: of all before `at`."""
    size = file.seek(0, SEEK_END)
    start, _, _ = FOOTER.unpack(read_at(file, size - END_BYTES + HEAD.size, FOOTER.size))
    data_end_at = start - DATA_END_BYTES
    checksum = zlib.crc32(_bytes(file, at, data_end_at), checksum)
    told = _bytes(file, data_end_at, start)
    if told not in (packed(DataEnd(checksum)), packed(DataEnd(0))):
        raise _DamageError(f"the data up to byte {data_end_at} does not fit its checksum")
