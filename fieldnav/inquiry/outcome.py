"""How a run ended, as far as its directory tells; also when the power went before it could say."""

from enum import Enum

from pydantic import BaseModel, ConfigDict

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.lines import JournalLines
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.ledger import Booking, last_booking
from fieldnav.journal.ledger_lock import being_driven
from fieldnav.journal.summary import Lanes, Summary, read_summary


class Outcome(Enum):
    FINISHED = "finished"
    STOPPED = "stopped"
    BROKEN_OFF = "broken off"
    RUNNING = "running"
    UNREADABLE = "unreadable"


class Overview(BaseModel):
    """One run in a line: how and where it ended, and its figures if they were written.

    seconds: how far the journal goes, or the ledger, which is written between transitions, too. lanes: as
    the summary has them, or else the ledger; None where neither does.
    """

    model_config = ConfigDict(frozen=True)

    run: str
    path: str
    outcome: Outcome
    last_state: str = ""
    reason: str = ""
    seconds: float = 0.0
    lanes: Lanes | None = None
    summary: Summary | None = None


def overview(directory: RunDirectory) -> Overview:
    """A run's overview, of its journal the last line alone; an unreadable run is one of the outcomes."""
    name, path = directory.path.name, str(directory.path)
    try:
        with JournalLines(directory.journal) as lines:
            last = lines.last
        summary = read_summary(directory.summary)
    except FieldnavError as error:
        return Overview(run=name, path=path, outcome=Outcome.UNREADABLE, reason=str(error))
    booking = _newest(directory)
    return Overview(
        run=name,
        path=path,
        outcome=_outcome(directory, summary),
        last_state=last.target if last else "",
        reason=last.reason if last and not (summary and summary.completed) else "",
        seconds=max(each.stamp_s if each else 0.0 for each in (last, booking)),
        lanes=summary.lanes if summary else booking and Lanes(done=len(booking.done), total=booking.lanes),
        summary=summary,
    )


def _newest(directory: RunDirectory) -> Booking | None:
    """Of the ledger; a run is told of without it where it cannot be read."""
    try:
        return last_booking(directory.ledger)
    except FieldnavError:
        return None


def _outcome(directory: RunDirectory, summary: Summary | None) -> Outcome:
    if being_driven(directory.ledger):
        return Outcome.RUNNING
    if summary is None:
        return Outcome.BROKEN_OFF
    return Outcome.FINISHED if summary.completed else Outcome.STOPPED
