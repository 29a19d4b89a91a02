"""Keeps a replay beside the run that it replays, and tells where the two differ.

A replay may go its own way for a while: change its state earlier, later, once more. The robot of the
recording, though, drives as it drove. Once the run has gone on by a second transition, or drives sideways
where the replay would drive along, the replay sees what it would never see. It is then brought to where the
run was.
"""

from collections.abc import Mapping, Sequence
from difflib import SequenceMatcher
from types import MappingProxyType

from fieldnav.journal.entry import Line
from fieldnav.replay.difference import Difference, Kind, judged_otherwise
from states.names import Event, Path, Phase
from states.table import LANE_LEAVES, LEAF_NAMED

MOST_APART = 2
"""Transitions that the run may be ahead; the robot then does another thing than the replay thinks."""


class Following:
    """Takes in, round by round, the transitions of then and of now."""

    def __init__(self) -> None:
        self.differences: list[Difference] = []
        self.transitions = 0
        self.judged: list[Difference] = []
        self._then: list[Line] = []
        self._now: list[Line] = []
        self._then_in = self._now_in = ""

    def take(self, then: Sequence[Line], now: Sequence[Line]) -> None:
        """The transitions of one round."""
        self.transitions += len(then)
        self._then += then
        self._now += now
        self._then_in = then[-1].target if then else self._then_in
        self._now_in = now[-1].target if now else self._now_in
        if self._then_in == self._now_in and _lanes(self._then) == _lanes(self._now):
            self._settle()

    @property
    def behind(self) -> tuple[Line, ...]:
        """The transitions through which the replay is to be brought, since the run has left it behind."""
        apart = MOST_APART if _manner(self._then_in) == _manner(self._now_in) else 1
        if len(self._then) < apart:
            return ()
        matched = {id(line) for line, _ in self._pairs()}
        return tuple(line for line in self._then if id(line) not in matched)

    def brought(self, lacked: Mapping[str, str]) -> None:
        """The replay stands where the run did; what each event lacked for coming by itself."""
        self._settle(lacked)
        self._now_in = self._then_in

    def end(self) -> None:
        """Nothing more comes."""
        self._settle()

    def _settle(self, lacked: Mapping[str, str] = MappingProxyType({})) -> None:
        """The two are in the same state: what has not found its partner by now has none."""
        pairs = self._pairs()
        for then, now in pairs:
            if then.stamp_s != now.stamp_s:
                self.differences.append(Difference(kind=Kind.MOVED, then=then, now=now))
            elif said := judged_otherwise(then, now):
                self.judged.append(Difference(kind=Kind.JUDGED, then=then, now=now, said=said))
        old, new = ({id(pair[side]) for pair in pairs} for side in (0, 1))
        self.differences += [
            Difference(kind=Kind.MISSING, then=line, said=lacked.get(line.event, ""))
            for line in self._then
            if id(line) not in old
        ]
        self.differences += [
            Difference(kind=Kind.ADDED, now=line) for line in self._now if id(line) not in new
        ]
        self._then, self._now = [], []

    def _pairs(self) -> list[tuple[Line, Line]]:
        """The transitions that are the same, in order."""
        matcher = SequenceMatcher(None, _keys(self._then), _keys(self._now), autojunk=False)
        return [
            (self._then[block.a + step], self._now[block.b + step])
            for block in matcher.get_matching_blocks()
            for step in range(block.size)
        ]


def _keys(lines: Sequence[Line]) -> list[tuple[str, str]]:
    return [(line.event, line.target) for line in lines]


def _lanes(lines: Sequence[Line]) -> int:
    """By how many lanes the lines go on."""
    return sum(line.event == Event.LANE_CENTRED.value for line in lines)


def _manner(state: str) -> Path | Phase | None:
    """How the robot moves in a state: along the lane, aside, or in its own way where it stands."""
    leaf = LEAF_NAMED.get(state)
    if leaf is None or leaf not in LANE_LEAVES:
        return leaf
    return Phase.SIDESTEP if Phase.SIDESTEP in leaf else Phase.FOLLOW
