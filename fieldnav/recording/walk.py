"""The records of an MCAP file one after another, by their heads, without reading what they hold."""

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import BinaryIO

from mcap.opcode import Opcode

HEAD = struct.Struct("<BQ")
"""Of any record: what it is and how many bytes follow."""

CHUNK_HEAD = struct.Struct("<QQQII")
"""Of a chunk: first and last time, size, checksum, and the length of the compression's name."""

LENGTH = struct.Struct("<Q")
LAST_BYTE = 1 << 43
"""Of the largest file; what a damaged head points to beyond it is not there."""

KNOWN = frozenset(int(opcode) for opcode in Opcode)


@dataclass(frozen=True, slots=True)
class Record:
    """One record of a file; it may reach beyond the file's end."""

    opcode: Opcode
    at: int
    length: int

    @property
    def body(self) -> int:
        return self.at + HEAD.size

    @property
    def end(self) -> int:
        return self.body + self.length


@dataclass(frozen=True, slots=True)
class ChunkHead:
    """What a chunk says of itself; `data_at`: where its records begin."""

    start_ns: int
    end_ns: int
    uncompressed_size: int
    compression: str
    data_at: int
    data_length: int


def read_at(file: BinaryIO, at: int, length: int) -> bytes:
    """Bytes of a file, fewer at its end."""
    if at > LAST_BYTE:
        return b""
    file.seek(at)
    return file.read(length)


def record_at(file: BinaryIO, at: int) -> Record | None:
    """The record that begins there; None where none does, or where its head is cut off."""
    head = read_at(file, at, HEAD.size)
    if len(head) < HEAD.size:
        return None
    opcode, length = HEAD.unpack(head)
    return Record(Opcode(opcode), at, length) if opcode in KNOWN else None


def records(file: BinaryIO, at: int, end: int) -> Iterator[Record]:
    """The records from `at` on that lie wholly before `end`, up to the first that does not."""
    while (record := record_at(file, at)) is not None and record.end <= end:
        yield record
        at = record.end


def chunk_head(file: BinaryIO, record: Record) -> ChunkHead | None:
    """The head of the chunk that a record is; None where it is cut off or makes no sense."""
    head = read_at(file, record.body, CHUNK_HEAD.size)
    if len(head) < CHUNK_HEAD.size:
        return None
    start_ns, end_ns, size, _, name_length = CHUNK_HEAD.unpack(head)
    data_at = record.body + CHUNK_HEAD.size + name_length + LENGTH.size
    if data_at > record.end:
        return None
    rest = read_at(file, record.body + CHUNK_HEAD.size, name_length + LENGTH.size)
    if len(rest) < name_length + LENGTH.size:
        return None
    (data_length,) = LENGTH.unpack(rest[name_length:])
    compression = rest[:name_length].decode(errors="replace")
    return ChunkHead(start_ns, end_ns, size, compression, data_at, data_length)
