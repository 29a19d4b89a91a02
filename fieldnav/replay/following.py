"""Keeps a replay beside the run that it replays, and tells where the two differ.

A replay may go its own way for a while: change its state earlier, later, once more. The robot of the
recording, though, drives as it drove. Once the run has gone on by a second transition and the replay has not
come after, what it sees is no longer what it would see: it is then brought to where the run was.
"""

from collections.abc import Sequence
from difflib import SequenceMatcher

from fieldnav.journal.entry import Line
from fieldnav.replay.difference import Difference, Kind, judged_otherwise

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
        if self._then_in == self._now_in and _lane(self._then) == _lane(self._now):
            self._settle()

    def behind(self, driving: bool) -> tuple[Line, ...]:
        """The transitions through which the replay is to be brought, since the run has left it behind.

        driving: whether the replay is in a state that may move the wheels; one that stands cannot come after.
        """
        if len(self._then) < (MOST_APART if driving else 1):
            return ()
        matched = {id(line) for line, _ in self._pairs()}
        return tuple(line for line in self._then if id(line) not in matched)

    def brought(self) -> None:
        """The replay stands where the run did."""
        self._settle()
        self._now_in = self._then_in

    def end(self) -> None:
        """Nothing more comes."""
        self._settle()

    def _settle(self) -> None:
        """The two are in the same state: what has not found its partner by now has none."""
        pairs = self._pairs()
        for then, now in pairs:
            if then.stamp_s != now.stamp_s:
                self.differences.append(Difference(kind=Kind.MOVED, then=then, now=now))
            elif said := judged_otherwise(then, now):
                self.judged.append(Difference(kind=Kind.JUDGED, then=then, now=now, said=said))
        old, new = ({id(pair[side]) for pair in pairs} for side in (0, 1))
        self.differences += [
            Difference(kind=Kind.MISSING, then=line) for line in self._then if id(line) not in old
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


def _lane(lines: Sequence[Line]) -> int:
    """How many lanes the lines go on by."""
    return sum(line.event == LANE_CENTRED for line in lines)


LANE_CENTRED = "lane centred"
