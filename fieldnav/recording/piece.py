"""One file of a recording while it is written."""

import fcntl
import os
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import BinaryIO, Protocol

from mcap.writer import CompressionType, Writer

from fieldnav import __version__
from fieldnav.journal.files import private
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.schemas import schema_of
from fieldnav.recording.stamps import Stamps

CHUNK_BYTES = 1 << 20
CHUNK_S = 0.25
"""A chunk ends at whichever comes first; what a killed process had not yet ended is lost."""

METADATA = "fieldnav"
BEGUN = "begun_utc"
MOST_SEQUENCE = 0xFFFFFFFF


class Opening(Protocol):
    """Opens a new file to be written. Raises OSError, also where there is one."""

    def __call__(self, path: Path, /) -> BinaryIO: ...


def new_file(path: Path) -> BinaryIO:
    """A new file for its owner alone, never one that exists. Raises OSError."""
    return open(path, "xb", opener=private)


class Piece:
    """Writes messages into a new MCAP file, which it locks; every method may raise OSError."""

    def __init__(self, path: Path, begun_utc: datetime, opening: Opening) -> None:
        self.path = path
        self._stamps = Stamps.since(begun_utc)
        self._schemas: dict[str, int] = {}
        self._channels: dict[Topic, int] = {}
        self._chunk_until_s = float("-inf")
        self._file = opening(path)
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX)
            self._file.truncate(0)  # a reader that came before the lock may have taken it for a broken one
            self._writer = Writer(
                self._file, chunk_size=CHUNK_BYTES, compression=CompressionType.NONE, enable_data_crcs=True
            )
            self._writer.start(profile="", library=f"fieldnav {__version__}")
            self._writer.add_metadata(METADATA, {BEGUN: begun_utc.isoformat(), "version": __version__})
            self._file.flush()
        except OSError:
            self.abandon()
            raise

    @property
    def size_bytes(self) -> int:
        """Of the file; up to one chunk more is in memory."""
        return self._file.tell()

    def write(self, message: Message) -> None:
        """Append one message; it is in the file once its chunk has ended."""
        channel = self._channels.get(message.topic) or self._register(message.topic)
        log_time = self._stamps.to_ns(message.stamp_s)
        sequence = message.sequence & MOST_SEQUENCE
        self._writer.add_message(channel, log_time, message.data, log_time, sequence)
        if message.stamp_s > self._chunk_until_s:
            self._chunk_until_s = message.stamp_s + CHUNK_S
            self._end_chunk()

    def sync(self) -> None:
        """On return what was written is on the disk."""
        self._end_chunk()
        os.fdatasync(self._file.fileno())

    def close(self) -> None:
        """Write the end, with its index, and close."""
        try:
            self._writer.finish()  # type: ignore[no-untyped-call] # the library's omission
            self._file.flush()
            os.fsync(self._file.fileno())
        finally:
            self.abandon()

    def abandon(self) -> None:
        """Close without an end; raises nothing."""
        with suppress(OSError):
            self._file.close()

    def _end_chunk(self) -> None:
        self._writer.flush()  # type: ignore[no-untyped-call] # the library's omission

    def _register(self, topic: Topic) -> int:
        """A schema and a channel begin a chunk: whoever writes an end anew finds them without a search."""
        self._end_chunk()
        schema = schema_of(topic)
        if schema.name not in self._schemas:
            self._schemas[schema.name] = self._writer.register_schema(
                schema.name, schema.encoding, schema.data
            )
        number = self._writer.register_channel(
            topic.value, schema.message_encoding, self._schemas[schema.name]
        )
        self._channels[topic] = number
        return number
