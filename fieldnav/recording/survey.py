"""What is whole in an MCAP file that has no end, or whose end is cut off: by the heads of its records."""

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from io import SEEK_END
from typing import BinaryIO

from mcap.opcode import Opcode
from mcap.records import ChunkIndex, MetadataIndex, Statistics
from mcap.summary import Summary
from mcap.writer import MCAP0_MAGIC

from fieldnav.recording.chunk_walk import Entries, Walked, walk_chunk, walk_heading
from fieldnav.recording.message_indexes import MessageIndexes, message_indexes
from fieldnav.recording.walk import ChunkHead, Record, chunk_head, read_at, record_at

NAME_LENGTH = struct.Struct("<I")


@dataclass(slots=True)
class Survey:
    """summary: as the file's end would have it.

    whole_to: the end of what can stay. last: the messages of the last chunk, if its index is not there;
    torn: its head promises more than there is.
    """

    summary: Summary = field(default_factory=Summary)
    whole_to: int = 0
    last: Entries = field(default_factory=dict)
    torn: bool = False


def survey(file: BinaryIO) -> Survey:
    """Walk through a file that begins as an MCAP file does. Raises OSError."""
    found, size, at = Survey(), file.seek(0, SEEK_END), len(MCAP0_MAGIC)
    found.summary.statistics = Statistics(0, 0, {}, 0, 0, 0, 0, 0, 0)
    while (record := record_at(file, at)) is not None and record.opcode is not Opcode.DATA_END:
        if record.opcode is Opcode.CHUNK:
            if not _take_chunk(file, record, size, found):
                break
        elif record.end > size:
            break
        else:
            _take_other(file, record, found)
        at = found.whole_to
    return found


def _take_other(file: BinaryIO, record: Record, found: Survey) -> None:
    found.whole_to = record.end
    if record.opcode is Opcode.METADATA and found.summary.statistics:
        (length,) = NAME_LENGTH.unpack(read_at(file, record.body, NAME_LENGTH.size))
        name = file.read(min(length, record.length)).decode(errors="replace")
        found.summary.metadata_indexes.append(MetadataIndex(record.at, record.end - record.at, name))
        found.summary.statistics.metadata_count += 1


def _take_chunk(file: BinaryIO, record: Record, size: int, found: Survey) -> bool:
    """Whether more may follow."""
    head = chunk_head(file, record)
    if head is None:
        return False
    heading = walk_heading(file, head.data_at, min(record.end, size))  # lies beside the head: one read
    indexes = message_indexes(file, record.end) if record.end <= size else None
    if indexes and indexes.counts.keys() <= found.summary.channels.keys() | heading.channels.keys():
        _add(found, _chunk_index(record, head, indexes), heading, indexes.counts)
        found.whole_to = indexes.end
        return True
    walked = walk_chunk(file, head.data_at, min(record.end, size), found.summary.channels)
    if walked.entries:
        found.whole_to = head.data_at + walked.length
        found.last, found.torn = walked.entries, found.whole_to != record.end
        counts = {channel: len(entries) for channel, entries in walked.entries.items()}
        _add(found, _walked_index(record, head, walked), walked, counts)
    return False


def _chunk_index(record: Record, head: ChunkHead, indexes: MessageIndexes) -> ChunkIndex:
    return ChunkIndex(
        chunk_start_offset=record.at,
        chunk_length=record.end - record.at,
        compression=head.compression,
        compressed_size=head.data_length,
        uncompressed_size=head.uncompressed_size,
        message_start_time=head.start_ns,
        message_end_time=head.end_ns,
        message_index_length=indexes.end - record.end,
        message_index_offsets=indexes.offsets,
    )


def _walked_index(record: Record, head: ChunkHead, walked: Walked) -> ChunkIndex:
    """Of a chunk as it will be; its indexes do not lie anywhere yet."""
    start_ns, end_ns = walked.span_ns
    return ChunkIndex(
        chunk_start_offset=record.at,
        chunk_length=head.data_at + walked.length - record.at,
        compression="",
        compressed_size=walked.length,
        uncompressed_size=walked.length,
        message_start_time=start_ns,
        message_end_time=end_ns,
        message_index_length=0,
        message_index_offsets={},
    )


def _add(found: Survey, index: ChunkIndex, walked: Walked, counts: Mapping[int, int]) -> None:
    summary, statistics = found.summary, found.summary.statistics
    assert statistics is not None, "made with the survey"
    summary.schemas.update(walked.schemas)
    summary.channels.update(walked.channels)
    earliest_ns = statistics.message_start_time if summary.chunk_indexes else index.message_start_time
    summary.chunk_indexes.append(index)
    statistics.message_start_time = min(earliest_ns, index.message_start_time)
    statistics.message_end_time = max(statistics.message_end_time, index.message_end_time)
    statistics.schema_count, statistics.channel_count = len(summary.schemas), len(summary.channels)
    statistics.chunk_count = len(summary.chunk_indexes)
    statistics.message_count += sum(counts.values())
    for channel, count in counts.items():
        known = statistics.channel_message_counts.get(channel, 0)
        statistics.channel_message_counts[channel] = known + count
