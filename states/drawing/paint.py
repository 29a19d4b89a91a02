"""A run as it is painted into the picture: plain figures, and the colours and widths that show them."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from math import log2, sqrt

from states.drawing.arrows import Arrow
from states.names import Event, Path
from states.table import TRANSITIONS

Made = tuple[Path, Event, Path]
"""A transition that was made, from leaf to leaf."""

EMPTY, FULL = (255, 255, 255), (13, 92, 128)
"""Red, green, blue of a state in which no time was spent, and of one in which all of it was."""
DARK = 0.75
"""From this depth of the colour on writing is white."""
TIMES = "\N{MULTIPLICATION SIGN}"
THINNEST, WIDER, WIDEST = 1.8, 0.7, 4.6
"""Width of an arrow taken once, how much wider it is for each doubling, and the most."""


@dataclass(frozen=True, slots=True)
class Visit:
    """All the visits to one leaf together."""

    seconds: float
    entries: int


@dataclass(frozen=True, slots=True)
class Paint:
    """A run's name, how it ended and why in words, its leaves and transitions, the leaf in which it ended.

    unknown: how many of its transitions are none of the table's: another version may have made them.
    """

    name: str
    outcome: str
    reason: str
    visits: Mapping[Path, Visit]
    made: Mapping[Made, int]
    ended: Path | None = None
    unknown: int = 0

    @property
    def seconds(self) -> float:
        """Of the whole run."""
        return sum(visit.seconds for visit in self.visits.values())

    def within(self, node: Path) -> Visit:
        """A leaf's visits, or of a composite those of its leaves."""
        inside = [visit for leaf, visit in self.visits.items() if leaf[: len(node)] == node]
        return Visit(sum(visit.seconds for visit in inside), sum(visit.entries for visit in inside))

    def depth(self, leaf: Path) -> float:
        """How deep a leaf's colour is, 0 to 1: the root of its share of the time, so that short ones show."""
        return sqrt(self.within(leaf).seconds / self.seconds) if self.seconds else 0.0

    def times(self) -> dict[tuple[Path, Event, Path | None], int]:
        """How often each arrow was taken; a composite's stands for all of its leaves."""
        times = Counter[tuple[Path, Event, Path | None]]()
        for (source, event, target), count in self.made.items():
            for row in TRANSITIONS:
                inside = source[: len(row.source)] == row.source and row.target in (target, None)
                if row.event is event and inside:
                    times[row.source, row.event, row.target] += count
        return dict(times)


def shade(depth: float) -> str:
    """The colour at a depth from 0 to 1."""
    mixed = (round(empty + depth * (full - empty)) for empty, full in zip(EMPTY, FULL, strict=True))
    return f"#{''.join(f'{part:02x}' for part in mixed)}"


def width(times: int) -> float:
    """Of an arrow that was taken so often, at least once."""
    return min(WIDEST, THINNEST + WIDER * log2(times))


def taken(arrow: Arrow, times: Mapping[tuple[Path, Event, Path | None], int]) -> int:
    """How often an arrow was taken."""
    return 0 if arrow.source is None else times.get((arrow.source, arrow.event, arrow.target), 0)


def clock(seconds: float) -> str:
    """A span of time as short as it reads well: 4.2 s, 1:23, 1:02:03."""
    if round(seconds, 1) < SECONDS_A_MINUTE:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), SECONDS_A_MINUTE)
    hours, minutes = divmod(minutes, MINUTES_AN_HOUR)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


SECONDS_A_MINUTE = MINUTES_AN_HOUR = 60
