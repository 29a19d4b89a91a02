"""The end of an MCAP file: read where it is whole, and written for what a survey found."""

import struct
import zlib
from collections.abc import Iterable
from io import SEEK_END, BytesIO
from typing import BinaryIO

from mcap.data_stream import RecordBuilder
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import (
    AttachmentIndex,
    Channel,
    ChunkIndex,
    DataEnd,
    Footer,
    McapRecord,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)
from mcap.stream_reader import StreamReader
from mcap.summary import Summary
from mcap.writer import MCAP0_MAGIC

from fieldnav.recording.walk import HEAD, read_at

FOOTER = struct.Struct("<QQI")
FOOTER_BYTES = HEAD.size + FOOTER.size
END_BYTES = FOOTER_BYTES + len(MCAP0_MAGIC)
CHECKSUM_BYTES = 4


def read_summary(file: BinaryIO) -> Summary | None:
    """What a whole file says of itself at its end; None where its end is not whole. Raises OSError."""
    size = file.seek(0, SEEK_END)
    end = read_at(file, max(0, size - END_BYTES), END_BYTES)
    if len(end) < END_BYTES or not end.endswith(MCAP0_MAGIC) or end[0] != Opcode.FOOTER:
        return None
    start, _, checksum = FOOTER.unpack(end[HEAD.size : FOOTER_BYTES])
    if not 0 < start < size - END_BYTES:
        return None
    content = read_at(file, start, size - start)
    checked = content[: -len(MCAP0_MAGIC) - CHECKSUM_BYTES]
    if checksum and zlib.crc32(checked) != checksum:
        return None
    try:
        return _summary(StreamReader(BytesIO(content), skip_magic=True).records)
    except (McapError, ValueError, struct.error):
        return None


def _summary(records: Iterable[McapRecord]) -> Summary:
    summary = Summary()
    for record in records:
        match record:
            case Schema():
                summary.schemas[record.id] = record
            case Channel():
                summary.channels[record.id] = record
            case ChunkIndex():
                summary.chunk_indexes.append(record)
            case MetadataIndex():
                summary.metadata_indexes.append(record)
            case AttachmentIndex():
                summary.attachment_indexes.append(record)
            case Statistics():
                summary.statistics = record
            case _:
                pass
    return summary


def packed(*records: McapRecord) -> bytes:
    """Records as they lie in a file."""
    builder = RecordBuilder()
    for record in records:
        record.write(builder)
    content: bytes = builder.end()  # type: ignore[no-untyped-call] # the library's omission
    return content


def ending(summary: Summary, at: int) -> bytes:
    """The end of a file whose data ends at byte `at`: the data's end, the summary, the footer."""
    data_end = packed(DataEnd(0))
    start = at + len(data_end)
    groups = {
        Opcode.SCHEMA: packed(*summary.schemas.values()),
        Opcode.CHANNEL: packed(*summary.channels.values()),
        Opcode.STATISTICS: packed(*[summary.statistics] if summary.statistics else []),
        Opcode.CHUNK_INDEX: packed(*summary.chunk_indexes),
        Opcode.METADATA_INDEX: packed(*summary.metadata_indexes),
    }
    content, offsets = b"", []
    for opcode, group in groups.items():
        if group:
            offsets.append(SummaryOffset(opcode, start + len(content), len(group)))
        content += group
    offset_start = start + len(content)
    content += packed(*offsets)
    return data_end + content + _footer(content, start, offset_start) + MCAP0_MAGIC


def _footer(summary: bytes, start: int, offset_start: int) -> bytes:
    """Its checksum covers the summary and all that stands before it in the footer."""
    unchecked = packed(Footer(start, offset_start, 0))
    checksum = zlib.crc32(unchecked[:-CHECKSUM_BYTES], zlib.crc32(summary))
    return packed(Footer(start, offset_start, checksum))
