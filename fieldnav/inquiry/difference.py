"""Two runs' transitions beside each other: aligned lane by lane, in order, by the way driven in the lane."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import groupby

from fieldnav.inquiry.alignment import aligned
from fieldnav.inquiry.stops import is_note
from fieldnav.journal.entry import Line


class Change(Enum):
    """What became of a transition from one run to the other."""

    MOVED = "moved"
    MISSING = "missing"
    ADDED = "added"


@dataclass(frozen=True, slots=True)
class Passed:
    """A transition: way_m driven and seconds since its lane began; way_m is None in journals without it."""

    line: Line
    way_m: float | None
    after_s: float

    @property
    def key(self) -> tuple[str, str, str]:
        return self.line.source, self.line.event, self.line.target


@dataclass(frozen=True, slots=True)
class Difference:
    """A transition of one run and what stands for it in the other."""

    change: Change
    lane: int | None
    before: Passed | None
    after: Passed | None

    @property
    def moved_m(self) -> float | None:
        """How much later on the way it came; None where a way is not known."""
        if self.before is None or self.after is None:
            return None
        return _apart(self.before.way_m, self.after.way_m)

    @property
    def moved_s(self) -> float | None:
        """How much later since the lane's beginning."""
        if self.before is None or self.after is None:
            return None
        return _apart(self.before.after_s, self.after.after_s)


@dataclass(frozen=True, slots=True)
class Tolerance:
    """What counts as not moved."""

    way_m: float
    seconds: float

    def same(self, pair: Difference) -> bool:
        """Whether both stand at the same place and time."""
        moved_m, moved_s = pair.moved_m or 0.0, pair.moved_s or 0.0
        return abs(moved_m) <= self.way_m and abs(moved_s) <= self.seconds


def differences(one: Iterable[Line], other: Iterable[Line], tolerance: Tolerance) -> list[Difference]:
    """What differs, lane by lane in the order of driving; empty for runs that are alike."""
    lanes, others = _by_lane(one), _by_lane(other)
    found: list[Difference] = []
    for lane in sorted({*lanes, *others}, key=lambda lane: -1 if lane is None else lane):
        for before, after in aligned(lanes.get(lane, ()), others.get(lane, ())):
            change = Change.ADDED if before is None else Change.MISSING if after is None else Change.MOVED
            pair = Difference(change, lane, before, after)
            if change is not Change.MOVED or not tolerance.same(pair):
                found.append(pair)
    return found


def _by_lane(lines: Iterable[Line]) -> dict[int | None, tuple[Passed, ...]]:
    """The transitions of each lane; a lane's way begins with its first."""
    lanes: dict[int | None, tuple[Passed, ...]] = {}
    for lane, within in groupby((line for line in lines if not is_note(line)), key=lambda line: line.lane):
        lanes[lane] = (*lanes.get(lane, ()), *_passed(list(within)))
    return lanes


def _passed(lines: Sequence[Line]) -> list[Passed]:
    first = lines[0]
    return [
        Passed(
            line,
            _total(_apart(first.forward_m, line.forward_m), _apart(first.sideways_m, line.sideways_m)),
            line.stamp_s - first.stamp_s,
        )
        for line in lines
    ]


def _apart(one: float | None, other: float | None) -> float | None:
    return None if one is None or other is None else other - one


def _total(forward_m: float | None, sideways_m: float | None) -> float | None:
    return None if forward_m is None or sideways_m is None else abs(forward_m) + abs(sideways_m)
