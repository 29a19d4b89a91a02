"""A run that was broken off, read back: where it was, with what settings, and up to which moment."""

import stat
from dataclasses import dataclass
from datetime import datetime, timedelta

from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import read
from fieldnav.journal.ledger import Booking, last_booking
from fieldnav.journal.resolved import Settings, read_settings
from fieldnav.messages import Direction, Side
from fieldnav.mission.bookkeeping import place_of
from fieldnav.settings.one_line import one_line
from fieldnav.settings.regular_file import NO_FILE
from states.names import Phase
from states.place import Place

MAX_BESIDE_M = 10.0
"""Of a robot beside the lane it left: more than any profile lets it step sideways."""
MAX_LISTED = 10
"""Lanes that a message names."""
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
    _refuse_what_is_no_file(directory)
    booking = last_booking(directory.ledger)
    if booking is None:
        raise FieldnavError(
            f"{directory.ledger}: holds no line: the run had not begun to drive; begin a new one"
        )
    if booking.finished:
        raise FieldnavError(f"{directory.path}: the run is finished; there is nothing to resume")
    try:
        _check_place(place_of(booking), booking.lanes)
    except SettingsError as error:
        raise SettingsError(f"{directory.ledger}: its last line: {error}") from error
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


def _check_place(place: Place, lanes: int) -> None:
    """Raises SettingsError for a place in which no mission can have been."""
    if place.lane > lanes:
        raise SettingsError(f"lane: {place.lane} is not allowed; allowed is a lane from 1 to {lanes}")
    forward = place.lane % 2 == 1  # the first lane is driven forward, the next one back
    if (place.direction is Direction.FORWARD) != forward:
        allowed = Direction.FORWARD if forward else Direction.BACKWARD
        raise SettingsError(
            f"state: '{place.direction.value}' is not allowed in lane {place.lane}; "
            f"allowed is {allowed.value}"
        )
    between = Phase.SIDESTEP in place.leaf
    if between and place.lane == lanes:
        raise SettingsError(f"state: a sidestep is not allowed in lane {place.lane}, the last of {lanes}")
    done = tuple(range(1, place.lane + between))
    if place.done != done:
        raise SettingsError(
            f"done: {_listed(place.done)} is not allowed in lane {place.lane}; allowed is {_listed(done)}"
        )
    beside_m = place.sideways_m - (place.sidestep_from_m or 0.0)
    if place.sidestep_from_m is not None and abs(beside_m) > MAX_BESIDE_M:
        raise SettingsError(
            f"sidestep_from_m: {place.sidestep_from_m:g} is not allowed; "
            f"allowed is at most {MAX_BESIDE_M:g} from sideways_m {place.sideways_m:g}"
        )


def _listed(lanes: tuple[int, ...]) -> str:
    """Some lanes, of many the first ones."""
    more = ", ..." if len(lanes) > MAX_LISTED else ""
    return f"[{', '.join(map(str, lanes[:MAX_LISTED]))}{more}]"


def _refuse_what_is_no_file(directory: RunDirectory) -> None:
    """A pipe or a device in a run's directory would be waited for, or be written into."""
    try:
        for path in sorted(directory.path.iterdir()):
            mode = path.stat().st_mode if path.exists() else stat.S_IFREG
            if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
                raise SettingsError(f"{one_line(str(path))}: {NO_FILE}")
    except OSError as error:
        raise FieldnavError(f"{directory.path}: cannot be read: {error.strerror}") from error
