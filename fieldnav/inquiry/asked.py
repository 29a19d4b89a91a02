"""The line of a journal that is asked about, with what stands around it."""

from dataclasses import dataclass
from itertools import islice, takewhile

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.choice import Choice, Chosen, Only
from fieldnav.inquiry.lines import JournalLines, Placed
from fieldnav.inquiry.moment import Moment, clock
from fieldnav.inquiry.outcome import Outcome, overview
from fieldnav.inquiry.stops import is_note, stands
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Line

NEAR_S = 1.0
"""So long after a line a moment is still the line's."""
ROUNDED_S = 0.05
"""Times are shown in tenths: a line may come so much sooner or later than it is shown."""
MOST_BEFORE = 200
"""Lines that are looked at for what led to one. Our choice."""


@dataclass(frozen=True, slots=True)
class Asked:
    """line: what happened, with `happened` False the last line before a moment at which nothing did.

    before: the lines before it, oldest first; after: the next one. broken_off: the run ended at the moment.
    """

    at_s: float
    line: Line
    before: tuple[Line, ...]
    after: Line | None
    happened: bool = True
    broken_off: bool = False


def asked_about(directory: RunDirectory, moment: Moment | None) -> Asked:
    """What a moment stands for; without one the end of a run that broke off, the last stop, the last change.

    Raises FieldnavError for a journal that cannot be read, is empty, or has no such moment.
    """
    with JournalLines(directory.journal) as lines:
        if lines.last is None:
            raise FieldnavError(f"{directory.journal}: holds no line yet")
        if moment is None:
            return _last(directory, lines, lines.last)
        if moment.seq is not None:
            return _numbered(lines, moment.seq, lines.last)
        return _at(directory, lines, moment.at_s or 0.0, lines.last)


def _last(directory: RunDirectory, lines: JournalLines, last: Line) -> Asked:
    broke_off = _broken_off(directory, lines, last)
    if broke_off is not None:
        return broke_off
    for only in (Only.STOPS, Only.CHANGES):
        for placed in Chosen(lines, Choice(only)):
            return _around(lines, placed)
    return _around(lines, next(lines.backwards()))


def _numbered(lines: JournalLines, number: int, last: Line) -> Asked:
    start = lines.find(lambda seq, _: seq >= number)
    placed = next(lines.forwards(start), None)
    if placed is None or (line := lines.parse(placed)).seq != number:
        raise FieldnavError(f"no line {number} in the journal; allowed is 0 to {last.seq}")
    return _around(lines, placed, line)


def _at(directory: RunDirectory, lines: JournalLines, at_s: float, last: Line) -> Asked:
    end = lines.find(lambda _, stamp_s: stamp_s > at_s + ROUNDED_S)
    if end == 0:
        raise FieldnavError(
            f"nothing was written down before {clock(at_s)}; the run ends at {clock(last.stamp_s)}"
        )
    placed = [(each, lines.parse(each)) for each in islice(lines.backwards(end), MOST_BEFORE)]
    near = list(takewhile(lambda each: at_s - each[1].stamp_s <= NEAR_S, placed))
    for each, line in sorted(near, key=lambda each: is_note(each[1])):  # stable: the nearest transition first
        return _around(lines, each, line)
    broke_off = _broken_off(directory, lines, last) if end == lines.end else None
    if broke_off is not None and at_s >= broke_off.at_s - ROUNDED_S:
        return broke_off
    older = tuple(line for _, line in reversed(placed))
    return Asked(at_s, older[-1], older[:-1], _first(lines, end), happened=False)


def _around(lines: JournalLines, placed: Placed, line: Line | None = None) -> Asked:
    start = placed[0]
    line = line or lines.parse(placed)
    before = tuple(lines.parse(each) for each in islice(lines.backwards(start), MOST_BEFORE))[::-1]
    return Asked(line.stamp_s, line, before, _first(lines, start + len(placed[1]) + 1))


def _first(lines: JournalLines, start: int) -> Line | None:
    placed = next(lines.forwards(start), None)
    return placed and lines.parse(placed)


def _broken_off(directory: RunDirectory, lines: JournalLines, last: Line) -> Asked | None:
    """The end of a run that ended without a stop; None for any other."""
    if stands(last):
        return None
    ended = overview(directory)
    if ended.outcome not in (Outcome.BROKEN_OFF, Outcome.STOPPED):
        return None
    around = _around(lines, next(lines.backwards()))
    return Asked(ended.seconds, around.line, around.before, None, happened=False, broken_off=True)
