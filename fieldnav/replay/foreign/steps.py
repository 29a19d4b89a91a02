"""Steps in the stamps of a recording: pictures a little out of order, and clocks that were set."""

from collections.abc import Iterator
from heapq import heappop, heappush

from fieldnav.errors import SettingsError
from fieldnav.replay.foreign.shot import NS_PER_S, Shot

MAX_GAP_S = 10.0
"""Stamps further apart are a gap; the slowest --rate has as much between two pictures. Our choice."""
MAX_BACK_S = 1.0
"""A stamp that is older by less is late; by more, from a clock that was set back. Our choice."""
LOOK_AHEAD = 8
"""Pictures that are held to be put in order; writers with several threads change the order of neighbours."""
MAX_GAP_NS, MAX_BACK_NS = round(MAX_GAP_S * NS_PER_S), round(MAX_BACK_S * NS_PER_S)

UNITS = (
    ("years", 365.25 * 86400.0),
    ("days", 86400.0),
    ("hours", 3600.0),
    ("minutes", 60.0),
    ("seconds", 1.0),
)
"""Of lengths of time, in s."""
ROUNDED_UP = 1.001
"""An hour less a picture is told as an hour."""
WHOLE_FROM = 10.0
"""Of any unit only whole ones are told; of fewer a decimal, too."""


def is_step(before_ns: int, after_ns: int) -> bool:
    """Whether two stamps, one after the other, are not of one stretch of time."""
    return not -MAX_BACK_NS <= after_ns - before_ns <= MAX_GAP_NS


def in_order(shots: Iterator[Shot]) -> Iterator[Shot]:
    """Neighbours in the order of their stamps; nothing is moved over a step.

    What was read before a broken place is given before that is told. Raises SettingsError there.
    """
    waiting: list[tuple[int, int, Shot]] = []
    newest_ns, broken = 0, None
    numbered = enumerate(shots)
    while True:
        try:
            number, shot = next(numbered)
        except StopIteration:
            break
        except SettingsError as error:
            broken = error
            break
        if waiting and is_step(newest_ns, shot.stamp_ns):
            yield from _emptied(waiting)
        newest_ns = max(newest_ns, shot.stamp_ns) if waiting else shot.stamp_ns
        heappush(waiting, (shot.stamp_ns, number, shot))
        if len(waiting) > LOOK_AHEAD:
            yield heappop(waiting)[2]
    yield from _emptied(waiting)
    if broken is not None:
        raise broken


def _emptied(waiting: list[tuple[int, int, Shot]]) -> Iterator[Shot]:
    while waiting:
        yield heappop(waiting)[2]


def long(seconds: float) -> str:
    """A length of time in its largest unit: 53 years, 1.5 hours."""
    length = abs(seconds) * ROUNDED_UP
    unit, size_s = next((each for each in UNITS if length >= each[1]), UNITS[-1])
    count = length / size_s
    shown = str(int(count)) if count >= WHOLE_FROM else f"{count:.1f}".removesuffix(".0")
    return f"{shown} {unit.removesuffix('s') if shown == '1' else unit}"
