"""Events that nearly came about: their conditions came close to their thresholds, and drew away again."""

from collections.abc import Iterable
from dataclasses import dataclass

from fieldnav.inquiry.chances import Chance, chances
from fieldnav.recording.records import Stepped

NEAR = 0.2
"""Share of its threshold that the farthest condition may lack and still be called near. Our choice."""
MOST_OF_AN_EVENT = 2
SOON_S = 5.0
"""An event that comes about so soon after was not missed. Our choice."""


@dataclass(frozen=True, slots=True)
class NearMiss:
    """The closest step of one approach to an event."""

    chance: Chance
    step: Stepped

    @property
    def lacking(self) -> float:
        """Share of the threshold."""
        return self.chance.lacking


class NearMisses:
    """Takes in one step after the other; an approach that ends in its event is none."""

    def __init__(self) -> None:
        self._found: list[NearMiss] = []
        self._open: dict[str, NearMiss] = {}
        self._place: tuple[str, int] | None = None

    def add(self, step: Stepped) -> None:
        """Take in a step; one that judged nothing says nothing."""
        if not step.evidence and not step.event:
            return
        if (step.state, step.lane) != self._place:
            self._close(list(self._open))
            self._place = (step.state, step.lane)
        for chance in chances(step.evidence):
            self._approach(NearMiss(chance, step))
        self._open.pop(step.event, None)
        if step.event:
            self._close(list(self._open))
            self._found = [miss for miss in self._found if not _came(miss, step)]

    def closest(self, most: int) -> list[NearMiss]:
        """The closest, no event more than twice."""
        self._close(list(self._open))
        chosen: list[NearMiss] = []
        for miss in sorted(self._found, key=lambda miss: (miss.lacking, miss.step.now_s)):
            if sum(other.chance.event == miss.chance.event for other in chosen) < MOST_OF_AN_EVENT:
                chosen.append(miss)
        return chosen[:most]

    def _approach(self, now: NearMiss) -> None:
        event = now.chance.event
        if now.chance.holds:
            self._open.pop(event, None)
        elif not _is_near(now.chance):
            self._close([event])
        elif event not in self._open or now.lacking < self._open[event].lacking:
            self._open[event] = now

    def _close(self, events: Iterable[str]) -> None:
        ended = (self._open.pop(event, None) for event in events)
        self._found += [miss for miss in ended if miss is not None]


def _came(miss: NearMiss, step: Stepped) -> bool:
    """Whether the step brought about soon what had nearly come."""
    return miss.chance.event == step.event and step.now_s - miss.step.now_s < SOON_S


def _is_near(chance: Chance) -> bool:
    """Of a threshold of 0 there is no share."""
    return chance.lacking <= NEAR and all(judged.threshold for judged in chance.deciding)
