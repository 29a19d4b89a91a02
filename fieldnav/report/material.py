"""Everything that a run's directory holds, as far as it can be read; what cannot is said, not raised."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.near_misses import NearMiss, NearMisses
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Line
from fieldnav.journal.journal import read
from fieldnav.journal.ledger import Booking
from fieldnav.journal.summary import Summary, read_summary
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Gap, Stepped
from fieldnav.report.bookings import bookings_of
from fieldnav.report.sights import SightColumns, Sights
from fieldnav.report.trail import Trail, trail_of
from fieldnav.settings.documents import parse_mapping, read_text

MOST_NEAR_MISSES = 6
Read = TypeVar("Read")


@dataclass(slots=True)
class Problems:
    """What could not be read, a sentence each."""

    said: list[str] = field(default_factory=list)

    def read(self, what: Callable[[], Read], otherwise: Read) -> Read:
        """What there is to read; `otherwise` when it cannot be read, which is then said."""
        try:
            return what()
        except FieldnavError as error:
            self.said.append(str(error))
            return otherwise


@dataclass(frozen=True, slots=True)
class Material:
    """What a run left behind. summary: None where there is none; recorded: whether there is a recording."""

    directory: RunDirectory
    lines: tuple[Line, ...]
    summary: Summary | None
    settings: dict[Any, Any]
    bookings: tuple[Booking, ...]
    trail: Trail
    sights: Sights
    near_misses: tuple[NearMiss, ...]
    gaps: tuple[Gap, ...]
    recorded: bool
    readable: bool
    problems: tuple[str, ...]


def gather(directory: RunDirectory, recording: Recording | None, problems: Problems) -> Material:
    """Read everything, a recording once from end to end without its pictures; raises nothing.

    problems: those of the recording, to which more may be added.
    """
    journal, others = Problems(), Problems()
    nothing: list[Line] = []
    lines = journal.read(lambda: read(directory.journal), nothing)
    ticks = problems.read(lambda: trail_of(recording.ticks() if recording else ()), trail_of(()))
    sights, near_misses = _steps(recording, problems)
    no_gaps: list[Gap] = []
    gaps = problems.read(lambda: list(recording.gaps() if recording else ()), no_gaps)
    label = str(directory.settings)
    return Material(
        directory=directory,
        lines=tuple(lines),
        summary=others.read(lambda: read_summary(directory.summary), None),
        settings=others.read(lambda: parse_mapping(read_text(label), label), {}),
        bookings=tuple(others.read(lambda: bookings_of(directory.ledger), [])),
        trail=ticks,
        sights=sights,
        near_misses=near_misses,
        gaps=tuple(gaps),
        recorded=recording is not None,
        readable=not journal.said,
        problems=(*journal.said, *others.said, *problems.said),
    )


def open_recording(directory: RunDirectory, problems: Problems) -> Recording | None:
    """The run's recording; None where there is none, or none that can be read, which is then said."""
    return problems.read(lambda: Recording.open(directory), None)


def _steps(recording: Recording | None, problems: Problems) -> tuple[Sights, tuple[NearMiss, ...]]:
    columns, near_misses = SightColumns(), NearMisses()

    def take_in(steps: Iterable[Stepped]) -> None:
        for step in steps:
            columns.add(step)
            near_misses.add(step)

    problems.read(lambda: take_in(recording.steps() if recording else ()), None)
    return columns.sights(), tuple(near_misses.closest(MOST_NEAR_MISSES))
