"""What lies in a chunk whose index is not there: schemas, channels, and each message's time and place."""

import struct
from dataclasses import dataclass, field
from io import BytesIO
from typing import BinaryIO

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Schema

from fieldnav.recording.walk import Record, read_at, records

MESSAGE_HEAD = struct.Struct("<HIQQ")
"""Of a message: channel, sequence, when it was logged, when it was published."""

Entries = dict[int, list[tuple[int, int]]]
"""By channel: nanoseconds of a message, and where it begins in its chunk's data."""


@dataclass(slots=True)
class Walked:
    """length: of the chunk's data up to the end of the last whole record in it."""

    length: int = 0
    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    entries: Entries = field(default_factory=dict)

    @property
    def span_ns(self) -> tuple[int, int]:
        """Earliest and latest time of a message."""
        times = [time for entries in self.entries.values() for time, _ in entries]
        return min(times, default=0), max(times, default=0)


def walk_chunk(file: BinaryIO, at: int, end: int, known: dict[int, Channel]) -> Walked:
    """Every whole record of a chunk's data; known: channels of earlier chunks."""
    walked = Walked()
    for record in records(file, at, end):
        if not _take(file, record, at, walked, known):
            break
        walked.length = record.end - at
    return walked


def walk_heading(file: BinaryIO, at: int, end: int) -> Walked:
    """The schemas and channels that a chunk begins with."""
    walked = Walked()
    for record in records(file, at, end):
        if record.opcode is Opcode.MESSAGE or not _take(file, record, at, walked, {}):
            break
    return walked


def _take(file: BinaryIO, record: Record, data_at: int, walked: Walked, known: dict[int, Channel]) -> bool:
    """Whether the record is one that belongs into a chunk."""
    if record.opcode is Opcode.MESSAGE:
        head = read_at(file, record.body, MESSAGE_HEAD.size)
        if record.length < MESSAGE_HEAD.size:
            return False
        channel, _, logged_ns, _ = MESSAGE_HEAD.unpack(head)
        if channel not in walked.channels and channel not in known:
            return False
        walked.entries.setdefault(channel, []).append((logged_ns, record.at - data_at))
        return True
    return record.opcode in (Opcode.SCHEMA, Opcode.CHANNEL) and _take_heading(file, record, walked)


def _take_heading(file: BinaryIO, record: Record, walked: Walked) -> bool:
    stream = ReadDataStream(BytesIO(read_at(file, record.body, record.length)))
    try:
        if record.opcode is Opcode.SCHEMA:
            schema = Schema.read(stream)
            walked.schemas[schema.id] = schema
        else:
            channel = Channel.read(stream)
            walked.channels[channel.id] = channel
    except (McapError, ValueError, struct.error):
        return False
    return stream.count == record.length
