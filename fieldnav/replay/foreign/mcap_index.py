"""What an MCAP file of others holds and where: by its summary, or, where that lacks something, by a walk."""

import struct
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from io import SEEK_END, BytesIO
from typing import BinaryIO, TypeVar

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, Schema
from mcap.stream_reader import CRCValidationError, get_chunk_data_stream
from mcap.summary import Summary
from mcap.writer import MCAP0_MAGIC

from fieldnav.recording.chunk_walk import MESSAGE_HEAD
from fieldnav.recording.ending import read_summary
from fieldnav.recording.walk import HEAD, read_at

AnyRecord = TypeVar("AnyRecord", Schema, Channel)
COMPRESSIONS = ("", "lz4", "zstd")


class DamageError(Exception):
    """What is wrong with a file, and where."""


@dataclass(frozen=True, slots=True)
class Message:
    """A message as it lies in a file."""

    channel: int
    written_ns: int
    data: bytes


@dataclass(frozen=True, slots=True)
class Place:
    """Where a chunk, or a message outside any chunk, begins; channels: those in it, None if unknown."""

    at: int
    channels: frozenset[int] | None = None


@dataclass(slots=True)
class McapIndex:
    """damage: what ends the file before its end, empty where nothing does."""

    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    places: list[Place] = field(default_factory=list)
    counts: Counter[int] = field(default_factory=Counter)
    first_ns: int = 0
    last_ns: int = 0
    damage: str = ""


def index_of(file: BinaryIO) -> McapIndex:
    """The index of an open file. Raises DamageError for what is no MCAP file, OSError."""
    if read_at(file, 0, len(MCAP0_MAGIC)) != MCAP0_MAGIC:
        raise DamageError("it does not begin as an MCAP file does")
    summary = read_summary(file)
    return _told(summary) if summary is not None and _is_whole(summary) else _walked(file)


def messages_at(file: BinaryIO, place: Place) -> Iterator[Message]:
    """The messages that a place holds, in written order. Raises DamageError."""
    opcode, body = _record(file, place.at)
    if opcode not in (Opcode.CHUNK, Opcode.MESSAGE):
        raise DamageError(f"there is no message at byte {place.at}, where the file says so")
    records = _in_chunk(body, place.at) if opcode == Opcode.CHUNK else iter([(opcode, body)])
    for kind, content in records:
        if kind == Opcode.MESSAGE:
            if len(content) < MESSAGE_HEAD.size:
                raise DamageError(f"a message in the record at byte {place.at} is cut off")
            channel, _, written_ns, _ = MESSAGE_HEAD.unpack_from(content)
            yield Message(channel, written_ns, content[MESSAGE_HEAD.size :])


def _is_whole(summary: Summary) -> bool:
    """Whether it tells of all that is in the file; each of its parts may lack."""
    told = summary.statistics
    return (
        told is not None
        and (told.schema_count, told.channel_count) == (len(summary.schemas), len(summary.channels))
        and all(each.schema_id in (0, *summary.schemas) for each in summary.channels.values())
        and told.chunk_count == len(summary.chunk_indexes)
        and (told.chunk_count > 0 or told.message_count == 0)
        and sum(told.channel_message_counts.values()) == told.message_count
    )


def _told(summary: Summary) -> McapIndex:
    told = summary.statistics
    assert told is not None, "the summary is whole"
    chunks = sorted(summary.chunk_indexes, key=lambda each: each.chunk_start_offset)
    return McapIndex(
        summary.schemas,
        summary.channels,
        [Place(each.chunk_start_offset, frozenset(each.message_index_offsets) or None) for each in chunks],
        Counter(told.channel_message_counts),
        told.message_start_time,
        told.message_end_time,
    )


def _walked(file: BinaryIO) -> McapIndex:
    """Every record up to the data's end, or to where the file breaks off; unknown ones are passed over."""
    found, at = McapIndex(), len(MCAP0_MAGIC)
    size = file.seek(0, SEEK_END)
    while at < size:
        head = read_at(file, at, HEAD.size)
        if len(head) < HEAD.size:
            break
        opcode, length = HEAD.unpack(head)
        if opcode == Opcode.DATA_END:
            return found
        if at + HEAD.size + length > size:
            break
        if opcode in (Opcode.CHUNK, Opcode.MESSAGE, Opcode.SCHEMA, Opcode.CHANNEL):
            _take(file, at, found)
        at += HEAD.size + length
    found.damage = found.damage or f"it breaks off at byte {at}"
    return found


def _take(file: BinaryIO, at: int, found: McapIndex) -> None:
    """One record that holds a part of what is looked for. A damaged one is told when it is read."""
    place = Place(at)
    try:
        opcode, body = _record(file, at)
        records = list(_in_chunk(body, at)) if opcode == Opcode.CHUNK else [(opcode, body)]
    except DamageError as error:
        found.places.append(place)
        found.damage = found.damage or str(error)
        return
    for kind, content in records:
        if kind == Opcode.SCHEMA and (schema := _parsed(Schema, content)):
            found.schemas[schema.id] = schema
        elif kind == Opcode.CHANNEL and (channel := _parsed(Channel, content)):
            found.channels[channel.id] = channel
        elif kind == Opcode.MESSAGE and len(content) >= MESSAGE_HEAD.size:
            number, _, written_ns, _ = MESSAGE_HEAD.unpack_from(content)
            earliest_ns = found.first_ns if found.counts else written_ns
            found.first_ns, found.last_ns = min(earliest_ns, written_ns), max(found.last_ns, written_ns)
            found.counts[number] += 1
    if opcode in (Opcode.CHUNK, Opcode.MESSAGE):
        found.places.append(place)


def _parsed(kind: type[AnyRecord], content: bytes) -> AnyRecord | None:
    try:
        record: AnyRecord = kind.read(ReadDataStream(BytesIO(content)))
    except (McapError, ValueError, struct.error):
        return None
    return record


def _record(file: BinaryIO, at: int) -> tuple[int, bytes]:
    head = read_at(file, at, HEAD.size)
    if len(head) < HEAD.size:
        raise DamageError(f"there is no record at byte {at}")
    opcode, length = HEAD.unpack(head)
    if at + HEAD.size + length > file.seek(0, SEEK_END):
        raise DamageError(f"the record at byte {at} is cut off")
    return opcode, read_at(file, at + HEAD.size, length)


def _in_chunk(body: bytes, at: int) -> Iterator[tuple[int, bytes]]:
    """The records of a chunk, whose checksum is right if it has one."""
    try:
        chunk = Chunk.read(ReadDataStream(BytesIO(body)))
        if chunk.compression not in COMPRESSIONS:
            allowed = ", ".join(each or "none" for each in COMPRESSIONS)
            raise DamageError(f"its chunks are compressed by '{chunk.compression}'; known are {allowed}")
        if not chunk.data:
            return
        stream, length = get_chunk_data_stream(chunk, validate_crc=True)
        content = stream.read(length)
    except CRCValidationError as error:
        raise DamageError(f"the chunk at byte {at} does not fit its checksum") from error
    except (McapError, ValueError, RuntimeError, MemoryError, struct.error) as error:
        raise DamageError(f"the chunk at byte {at} cannot be unpacked: {error}") from error
    begin = 0
    while begin < len(content):
        if begin + HEAD.size > len(content):
            raise DamageError(f"the chunk at byte {at} is cut off")
        opcode, length = HEAD.unpack_from(content, begin)
        end = begin + HEAD.size + length
        if end > len(content):
            raise DamageError(f"a record in the chunk at byte {at} is cut off")
        yield opcode, content[begin + HEAD.size : end]
        begin = end


def counts_of(index: McapIndex) -> Mapping[str, int]:
    """How many messages each topic has, over all channels of its name."""
    found: Counter[str] = Counter()
    for number, channel in index.channels.items():
        found[channel.topic] += index.counts[number]
    return found
