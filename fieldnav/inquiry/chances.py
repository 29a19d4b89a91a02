"""What could have come of what a state judged: each event with its conditions, and how much it lacked."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import inf

from fieldnav.journal.entry import Judged


@dataclass(frozen=True, slots=True)
class Chance:
    """One event that a judgement could have led to; conditions: all that have to hold, or one `alone`."""

    event: str
    conditions: tuple[Judged, ...]

    @property
    def holds(self) -> bool:
        """Whether the conditions are such that the event comes about."""
        joint = [each for each in self.conditions if not each.alone]
        return any(each.alone and each.holds for each in self.conditions) or (
            bool(joint) and all(each.holds for each in joint)
        )

    @property
    def deciding(self) -> tuple[Judged, ...]:
        """The conditions that made the event; else the one that it lacked."""
        if self.holds:
            alone = tuple(each for each in self.conditions if each.alone and each.holds)
            return alone or tuple(each for each in self.conditions if not each.alone)
        return (min(self._lacking(), key=lacking_share),)

    @property
    def lacking(self) -> float:
        """How much it lacked, as a share of the threshold; infinite where nothing is known."""
        return 0.0 if self.holds else min(map(lacking_share, self._lacking()))

    def _lacking(self) -> list[Judged]:
        """What would have been enough: the joint conditions by their worst, or any that is alone."""
        joint = [each for each in self.conditions if not each.alone]
        worst = [max(joint, key=lacking_share)] if joint else []
        return worst + [each for each in self.conditions if each.alone]


def lacking_share(condition: Judged) -> float:
    """How much one condition lacks, as a share of its threshold; of a threshold of zero, in its unit."""
    if condition.holds:
        return 0.0
    if condition.margin is None or condition.threshold is None:
        return inf
    return -condition.margin / (abs(condition.threshold) or 1.0)


def chances(evidence: Iterable[Judged]) -> list[Chance]:
    """The events of a judgement, the closest first; none where it does not say what it is a condition of."""
    conditions: dict[str, list[Judged]] = {}
    for judged in evidence:
        if judged.fires:
            conditions.setdefault(judged.fires, []).append(judged)
    found = [Chance(event, tuple(each)) for event, each in conditions.items()]
    return sorted(found, key=lambda chance: chance.lacking)


def deciding(event: str, evidence: Sequence[Judged]) -> tuple[Judged, ...]:
    """The conditions that made the event; of an older journal all that was held against a threshold."""
    for chance in chances(evidence):
        if chance.event == event:
            return chance.deciding if chance.holds else chance.conditions
    if any(judged.fires for judged in evidence):
        return ()
    return tuple(judged for judged in evidence if judged.threshold is not None)
