"""Where a run's time went: how long it was in each state, how far it came there, how often it entered it."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import hypot

from fieldnav.journal.entry import Line

Made = tuple[str, str, str]
"""Source, event and target of a transition."""


@dataclass(frozen=True, slots=True)
class Spent:
    """What was spent in one state, all its visits together.

    metres: as the crow flies from line to line; 0 where a journal does not tell.
    """

    seconds: float
    metres: float
    entries: int


@dataclass(frozen=True, slots=True)
class Account:
    """A run's states in the order of their first entry, how often each transition was made, where it ended.

    last: empty where nothing was written down.
    """

    states: Mapping[str, Spent]
    made: Mapping[Made, int]
    last: str

    @property
    def seconds(self) -> float:
        """In all states together; while a run that was broken off did not run it was in none."""
        return sum(spent.seconds for spent in self.states.values())


def account(lines: Iterable[Line], until_s: float | None = None) -> Account:
    """What a journal's lines tell; until_s: how long the last state went on, where that is known."""
    seconds, metres = defaultdict[str, float](float), defaultdict[str, float](float)
    entries, made = Counter[str](), Counter[Made]()
    before: Line | None = None
    for line in lines:
        if before is not None and before.target == line.source:
            seconds[line.source] += line.stamp_s - before.stamp_s
            metres[line.source] += _apart_m(before, line)
        else:  # the run begins, or is taken up after it was broken off
            entries[line.source] += 1
        if line.target != line.source:
            entries[line.target] += 1
            made[line.source, line.event, line.target] += 1
        before = line
    if before is not None and until_s is not None:
        seconds[before.target] += max(0.0, until_s - before.stamp_s)
    states = {state: Spent(seconds[state], metres[state], times) for state, times in entries.items()}
    return Account(states, made, before.target if before else "")


def _apart_m(one: Line, other: Line) -> float:
    """Between the places of two lines."""
    return hypot(_way_m(one.forward_m, other.forward_m), _way_m(one.sideways_m, other.sideways_m))


def _way_m(one: float | None, other: float | None) -> float:
    return 0.0 if one is None or other is None else other - one
