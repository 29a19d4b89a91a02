"""The message indexes that follow a chunk: how many messages it holds on each channel, and where."""

import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import BinaryIO

from mcap.opcode import Opcode

from fieldnav.recording.walk import read_at, record_at

AFTER_INDEXES = (Opcode.CHUNK, Opcode.METADATA, Opcode.DATA_END)
"""What shows that the message indexes before it are all there."""

INDEX_HEAD = struct.Struct("<HI")
"""Of a message index: channel, and the length of its entries."""

ENTRY_BYTES = 16


@dataclass(frozen=True, slots=True)
class MessageIndexes:
    """counts, offsets: number of messages and place of the index by channel; end: where they end."""

    counts: Mapping[int, int]
    offsets: dict[int, int]
    end: int


def message_indexes(file: BinaryIO, at: int) -> MessageIndexes | None:
    """The message indexes from `at` on; None where some may lack."""
    counts, offsets = {}, {}
    while (record := record_at(file, at)) is not None and record.opcode is Opcode.MESSAGE_INDEX:
        head = read_at(file, record.body, INDEX_HEAD.size)
        if len(head) < INDEX_HEAD.size:
            return None
        channel, length = INDEX_HEAD.unpack(head)
        counts[channel], offsets[channel] = length // ENTRY_BYTES, record.at
        at = record.end
    if record is None or record.opcode not in AFTER_INDEXES:
        return None
    return MessageIndexes(counts, offsets, at)
