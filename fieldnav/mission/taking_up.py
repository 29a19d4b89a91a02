"""A run that was broken off, read back: where it was, with what settings, and up to which moment."""

from dataclasses import dataclass
from datetime import datetime, timedelta

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import read
from fieldnav.journal.ledger import Booking, last_booking
from fieldnav.journal.resolved import Settings, read_settings
from fieldnav.messages import Side
from fieldnav.mission.bookkeeping import place_of

GAP_S = 1.0
"""A run goes on at least so much later than its last line, also where the wall clock was set back."""


@dataclass(frozen=True, slots=True)
class BrokenOff:
    """begun_utc: when the run began, from which its stamps count; last_s: the newest of them."""

    directory: RunDirectory
    settings: Settings
    booking: Booking
    lanes: int
    side: Side
    begun_utc: datetime
    last_s: float

    def begin_s(self, utc: datetime) -> float:
        """The stamp at which the run goes on."""
        return max((utc - self.begun_utc).total_seconds(), self.last_s + GAP_S)


def broken_off(directory: RunDirectory) -> BrokenOff:
    """What is known of a run. Raises FieldnavError for one that cannot be, or need not be, taken up."""
    booking = last_booking(directory.ledger)
    if booking is None:
        raise FieldnavError(
            f"{directory.ledger}: holds no line: the run had not begun to drive; begin a new one"
        )
    if booking.finished:
        raise FieldnavError(f"{directory.path}: the run is finished; there is nothing to resume")
    place_of(booking)
    lines = read(directory.journal)
    if not lines:
        raise FieldnavError(f"{directory.journal}: holds no line; begin a new run")
    return BrokenOff(
        directory=directory,
        settings=read_settings(directory.settings),
        booking=booking,
        lanes=booking.lanes,
        side=Side(booking.side),
        begun_utc=lines[0].utc - timedelta(seconds=lines[0].stamp_s),
        last_s=max(lines[-1].stamp_s, booking.stamp_s),
    )
