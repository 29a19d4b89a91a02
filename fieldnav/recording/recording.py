"""A run's recording, read back: opened without being read, whatever its length and however it ended."""

from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from math import inf
from types import TracebackType
from typing import Self, TypeVar

from pydantic import ValidationError

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import CameraName
from fieldnav.recording.message import Topic
from fieldnav.recording.opening import Reading, existing_file
from fieldnav.recording.picture import Picture, pictured, same
from fieldnav.recording.piece_names import number_of, piece_path, pieces_in
from fieldnav.recording.piece_reader import PieceReader, Read
from fieldnav.recording.records import Gap, Record, Round, Seen, Stepped, Ticked
from fieldnav.recording.stamps import NS_PER_US

AnyRecord = TypeVar("AnyRecord", bound=Record)
IMAGES = {Topic.image(camera): camera for camera in CameraName}


class Recording:
    """What was recorded, by the run's own seconds; both ends of a stretch of time are included.

    Raises FieldnavError where a file is damaged.
    """

    def __init__(self, directory: RunDirectory, pieces: Sequence[PieceReader]) -> None:
        self._directory, self._pieces = directory, pieces

    @classmethod
    def open(cls, directory: RunDirectory, reading: Reading = existing_file) -> Self | None:
        """Open a run's recording; None where there is none.

        A file that broke off gets its end, unless it is being written. Raises FieldnavError.
        """
        pieces: list[PieceReader] = []
        path = directory.recording
        try:
            for path in pieces_in(directory).values():
                with suppress(FileNotFoundError):  # given up by its recorder meanwhile
                    pieces.append(PieceReader(path, reading))
        except (OSError, FieldnavError) as error:
            for piece in pieces:
                piece.close()
            if isinstance(error, OSError):
                raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error
            raise
        return cls(directory, pieces) if pieces else None

    @property
    def begin_s(self) -> float:
        """The first message's stamp; 0 where there is none."""
        spans = [(piece, piece.span_ns) for piece in self._pieces]
        return min((piece.stamps.to_s(span[0]) for piece, span in spans if span), default=0.0)

    @property
    def end_s(self) -> float:
        """The last message's stamp; 0 where there is none."""
        spans = [(piece, piece.span_ns) for piece in self._pieces]
        return max((piece.stamps.to_s(span[1]) for piece, span in spans if span), default=0.0)

    def rounds(self, begin_s: float = -inf, end_s: float = inf) -> Iterator[Round]:
        """What the mission took in and gave out, call by call."""
        return self._records(Topic.ROUND, Round, begin_s, end_s)

    def ticks(self, begin_s: float = -inf, end_s: float = inf) -> Iterator[Ticked]:
        """How the mission stood, tick by tick."""
        return self._records(Topic.TICK, Ticked, begin_s, end_s)

    def steps(self, begin_s: float = -inf, end_s: float = inf) -> Iterator[Stepped]:
        """What the states judged."""
        return self._records(Topic.STEP, Stepped, begin_s, end_s)

    def gaps(self) -> Iterator[Gap]:
        """Where pictures lack."""
        return self._records(Topic.GAP, Gap, -inf, inf)

    def pictures(self, begin_s: float = -inf, end_s: float = inf) -> Iterator[Picture]:
        """Pictures of both cameras as they were written; their stamps are exact to a nanosecond."""
        for piece, read in self._read(IMAGES.keys(), begin_s, end_s):
            stamp_s = piece.stamps.to_s(read.log_time_ns)
            yield pictured(
                Seen(camera=IMAGES[read.topic], sequence=read.sequence, stamp_s=stamp_s), read.data
            )

    def picture(self, seen: Seen) -> Picture | None:
        """The picture of a frame, which may be known to a microsecond only; None where it lacks."""
        for piece in self._pieces:
            at_ns = piece.stamps.to_ns(seen.stamp_s)
            for read in piece.messages((Topic.image(seen.camera),), at_ns - NS_PER_US, at_ns + NS_PER_US):
                if same(read.sequence, seen.sequence):
                    return pictured(seen, read.data)
        return None

    def check(self) -> None:
        """Read all of it. Raises FieldnavError for a file that is not as it was written."""
        for piece in self._pieces:
            piece.check()

    @property
    def lacking(self) -> list[str]:
        """The files that are not there, between the first and the last of those that are."""
        found = [number_of(piece.path) for piece in self._pieces]
        absent = set(range(min(found), max(found))) - set(found)
        return [piece_path(self._directory, number).name for number in sorted(absent)]

    def close(self) -> None:
        for piece in self._pieces:
            piece.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _read(
        self, topics: Collection[Topic], begin_s: float, end_s: float
    ) -> Iterator[tuple[PieceReader, Read]]:
        for piece in self._pieces:
            for read in piece.messages(topics, piece.stamps.to_ns(begin_s), piece.stamps.to_ns(end_s)):
                yield piece, read

    def _records(
        self, topic: Topic, kind: type[AnyRecord], begin_s: float, end_s: float
    ) -> Iterator[AnyRecord]:
        for piece, read in self._read((topic,), begin_s, end_s):
            try:
                yield kind.model_validate_json(read.data)
            except ValidationError as error:
                at_s = piece.stamps.to_s(read.log_time_ns)
                raise FieldnavError(
                    f"{piece.path}: the message on {topic.value} at {at_s} s is none"
                ) from error
