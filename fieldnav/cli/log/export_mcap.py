"""A run as one MCAP file: all pieces of its recording, or its journal where there is none."""

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.lines import JournalLines
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.files import whole_file
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.opening import existing_file
from fieldnav.recording.piece import Piece, new_file
from fieldnav.recording.piece_names import pieces_in
from fieldnav.recording.piece_reader import PieceReader
from fieldnav.recording.stamps import EPOCH, NS_PER_US


def export_mcap(directory: RunDirectory, target: Path) -> None:
    """Write the whole file or nothing. Raises FieldnavError, OutputError."""
    with whole_file(target) as beside:
        beside.unlink(missing_ok=True)
        pieces = list(pieces_in(directory).values())
        messages = _recorded(pieces) if pieces else _written_down(directory)
        piece = Piece(beside, _begun(directory, pieces), new_file)
        for message in messages:
            piece.write(message)
        piece.close()


def _begun(directory: RunDirectory, pieces: list[Path]) -> datetime:
    """When the run began, from which its stamps count. Raises FieldnavError."""
    if pieces:
        reader = PieceReader(pieces[0], existing_file)
        begun_ns = reader.stamps.begun_ns
        reader.close()
        return EPOCH + timedelta(microseconds=begun_ns / NS_PER_US)
    with JournalLines(directory.journal) as journal:
        first = next(journal.forwards(), None)
        if first is None:
            raise FieldnavError(f"{directory.journal}: holds no line yet")
        line = journal.parse(first)
        return line.utc.astimezone(UTC) - timedelta(seconds=line.stamp_s)


def _recorded(pieces: list[Path]) -> Iterator[Message]:
    """What the pieces hold, one after the other."""
    for path in pieces:
        reader = PieceReader(path, existing_file)
        begin_ns, end_ns = reader.span_ns or (0, 0)
        for read in reader.messages(tuple(Topic), begin_ns, end_ns):
            yield Message(read.topic, reader.stamps.to_s(read.log_time_ns), read.data, read.sequence)
        reader.close()


def _written_down(directory: RunDirectory) -> Iterator[Message]:
    """The journal's lines as they stand."""
    with JournalLines(directory.journal) as journal:
        for placed in journal.forwards():
            line = journal.parse(placed)
            yield Message(Topic.TRANSITION, line.stamp_s, placed[1], line.seq)
