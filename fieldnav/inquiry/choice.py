"""Which lines of a journal are wanted, told from how they begin."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from itertools import islice
from math import inf

from fieldnav.inquiry.line_head import Names, names_of
from fieldnav.inquiry.lines import JournalLines, Placed
from fieldnav.inquiry.stops import stops
from fieldnav.journal.entry import Line


class Only(Enum):
    """Which kind of lines."""

    LINES = "all lines"
    CHANGES = "changes of state"
    STOPS = "stops"


@dataclass(frozen=True, slots=True)
class Choice:
    """Lines of which all of this is true; of a state its name or a part of it, of an event a part of it."""

    only: Only = Only.LINES
    state: str = ""
    event: str = ""
    lane: int | None = None
    from_s: float = -inf
    to_s: float = inf

    def wants(self, event: str, source: str, target: str) -> bool:
        """Whether a line from state to state on this event is chosen, whatever its lane and time."""
        if self.only is Only.STOPS and not stops(event, source, target):
            return False
        if self.only is Only.CHANGES and source == target:
            return False
        if self.event.lower() not in event.lower():
            return False
        return not self.state or any(_within(self.state, state) for state in (source, target))


def _within(part: str, state: str) -> bool:
    """Whether the names of the part follow each other in the state's: Sidestep.Crossing, Tracking."""
    return f".{part.lower()}." in f".{state.lower()}."


class Chosen:
    """The lines of a journal that are chosen, newest first and not parsed yet."""

    def __init__(self, lines: JournalLines, choice: Choice) -> None:
        self._lines, self._choice = lines, choice
        self._named: dict[Names, bool] = {}

    def __iter__(self) -> Iterator[Placed]:
        choice, lines = self._choice, self._lines
        begin = lines.find(lambda _, stamp_s: stamp_s >= choice.from_s) if choice.from_s > -inf else 0
        end = lines.find(lambda _, stamp_s: stamp_s > choice.to_s) if choice.to_s < inf else lines.end
        return (placed for placed in lines.backwards(end, begin) if self._wants(placed))

    def newest(self, most: int | None = None) -> tuple[list[Line], int]:
        """The newest of them in the order of the file, all without `most`; and how many there are besides.

        Raises FieldnavError for one that is none of a journal's.
        """
        chosen = iter(self)
        lines = [self._lines.parse(placed) for placed in islice(chosen, most)]
        return lines[::-1], sum(1 for _ in chosen)

    def _wants(self, placed: Placed) -> bool:
        told = names_of(placed[1])
        if told is None:
            line = self._lines.parse(placed)
            return self._wants_lane(line.lane) and self._choice.wants(line.event, line.source, line.target)
        names, lane = told
        return self._wants_lane(lane) and self._wants_named(names)

    def _wants_lane(self, lane: int | None) -> bool:
        return self._choice.lane is None or lane == self._choice.lane

    def _wants_named(self, names: Names) -> bool:
        """There are few states and events, and many lines."""
        if names not in self._named:
            event, source, target = (name.decode(errors="replace") for name in names)
            self._named[names] = self._choice.wants(event, source, target)
        return self._named[names]
