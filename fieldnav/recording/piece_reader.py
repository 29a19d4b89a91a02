"""One file of a recording, read by its index: only what is asked for."""

import struct
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from io import SEEK_END, BytesIO
from pathlib import Path

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import ChunkIndex, Metadata
from numpy.typing import NDArray

from fieldnav.errors import FieldnavError
from fieldnav.recording.chunk_walk import MESSAGE_HEAD
from fieldnav.recording.message import Topic
from fieldnav.recording.message_indexes import ENTRY_BYTES, INDEX_HEAD
from fieldnav.recording.opening import Reading, opened
from fieldnav.recording.piece import BEGUN, METADATA
from fieldnav.recording.soundness import check_sound
from fieldnav.recording.stamps import Stamps
from fieldnav.recording.walk import CHUNK_HEAD, HEAD, LENGTH, read_at

Entries = NDArray[np.int64]
"""Shape (n, 2): nanoseconds of a message, and where it begins in its chunk's data."""

MESSAGE_BYTES = HEAD.size + MESSAGE_HEAD.size
KNOWN_TOPICS = {topic.value: topic for topic in Topic}


@dataclass(frozen=True, slots=True)
class Read:
    """One message as read back."""

    topic: Topic
    log_time_ns: int
    sequence: int
    data: bytes


class PieceReader:
    """Finds and reads messages. Raises FieldnavError where the file is damaged."""

    def __init__(self, path: Path, reading: Reading) -> None:
        """Raises OSError, FieldnavError for what is no MCAP file."""
        self.path = path
        self._opened = opened(path, reading)
        self._file = self._opened.file
        self._size = self._file.seek(0, SEEK_END)
        summary = self._opened.summary
        topics = {number: KNOWN_TOPICS.get(channel.topic) for number, channel in summary.channels.items()}
        self._topics = {number: topic for number, topic in topics.items() if topic is not None}
        self._chunks = summary.chunk_indexes
        spans = [(chunk.message_start_time, chunk.message_end_time) for chunk in self._chunks]
        self._spans_ns = _signed(spans)
        try:
            self.stamps = self._read_stamps()
        except FieldnavError:
            self.close()
            raise

    @property
    def span_ns(self) -> tuple[int, int] | None:
        """When the first and the last message were logged; None where there is none."""
        if not self._chunks:
            return None
        return int(self._spans_ns[:, 0].min()), int(self._spans_ns[:, 1].max())

    def messages(self, topics: Collection[Topic], begin_ns: int, end_ns: int) -> Iterator[Read]:
        """The messages on these topics from `begin_ns` to `end_ns`, both included, as they were written."""
        channels = [number for number, topic in self._topics.items() if topic in topics]
        within = (self._spans_ns[:, 1] >= begin_ns) & (self._spans_ns[:, 0] <= end_ns)
        for chunk in np.flatnonzero(within).tolist():
            entries = np.concatenate([_NONE, *(self._entries(chunk, number) for number in channels)])
            asked = entries[(entries[:, 0] >= begin_ns) & (entries[:, 0] <= end_ns)]
            for offset in np.sort(asked[:, 1]).tolist():
                yield self._message(self._chunks[chunk], offset)

    def check(self) -> None:
        """Read the whole file. Raises FieldnavError for what is not as it was written."""
        check_sound(self.path, self._opened)

    def close(self) -> None:
        self._file.close()

    def _read_stamps(self) -> Stamps:
        """From the run's beginning as the file tells it; in a file of others from its first message."""
        for index in self._opened.summary.metadata_indexes:
            if index.name == METADATA:
                body = self._bytes(index.offset + HEAD.size, index.length - HEAD.size)
                try:
                    said = Metadata.read(ReadDataStream(BytesIO(body))).metadata
                    return Stamps.since(datetime.fromisoformat(said[BEGUN]))
                except (McapError, KeyError, ValueError, TypeError, struct.error) as error:
                    raise self._damaged(index.offset) from error
        return Stamps(self.span_ns[0] if self.span_ns else 0)

    def _entries(self, chunk: int, channel: int) -> Entries:
        """A chunk's messages on one channel."""
        index = self._chunks[chunk]
        if self._opened.last and chunk == len(self._chunks) - 1:
            return _signed(self._opened.last.get(channel, ()))
        at = index.message_index_offsets.get(channel)
        if at is None:
            return _NONE
        head = self._bytes(at, HEAD.size + INDEX_HEAD.size)
        if head[0] != Opcode.MESSAGE_INDEX:
            raise self._damaged(at)
        _, length = INDEX_HEAD.unpack(head[HEAD.size :])
        content = self._bytes(at + len(head), length // ENTRY_BYTES * ENTRY_BYTES)
        return np.frombuffer(content, dtype="<i8").reshape(-1, 2)

    def _message(self, chunk: ChunkIndex, offset: int) -> Read:
        at = chunk.chunk_start_offset + HEAD.size + CHUNK_HEAD.size + LENGTH.size + offset
        head = self._bytes(at, MESSAGE_BYTES)
        _, length = HEAD.unpack(head[: HEAD.size])
        channel, sequence, log_time_ns, _ = MESSAGE_HEAD.unpack(head[HEAD.size :])
        if chunk.compression or head[0] != Opcode.MESSAGE or channel not in self._topics:
            raise self._damaged(at)
        data = self._bytes(at + len(head), length - MESSAGE_HEAD.size)
        return Read(self._topics[channel], log_time_ns, sequence, data)

    def _bytes(self, at: int, length: int) -> bytes:
        """Bytes that an index, which may lie, says are there."""
        if min(at, length) < 0 or at + length > self._size:
            raise self._damaged(at)
        try:
            return read_at(self._file, at, length)
        except OSError as error:
            raise FieldnavError(f"{self.path}: cannot be read: {error.strerror}") from error

    def _damaged(self, at: int) -> FieldnavError:
        return FieldnavError(f"{self.path}: is damaged, or was compressed by others, at byte {at}")


def _signed(pairs: Sequence[tuple[int, int]]) -> Entries:
    """Pairs of 64 bits, where damaged of all 64."""
    return np.array(pairs, dtype=np.uint64).reshape(-1, 2).astype(np.int64)


_NONE: Entries = np.empty((0, 2), dtype=np.int64)
