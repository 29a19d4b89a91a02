"""At which share of a box's height each arrow meets its side, and in which order tracks lie side by side."""

from collections.abc import Hashable, Mapping, Sequence

from states.drawing.arrows import Arrow, Track, Way
from states.drawing.boxes import Node, column_of, nodes_of

_OUTWARD = {Way.ASIDE: 0, Way.ACROSS: 1, Way.AROUND: 2}
"""Order of the tracks from their column outward."""

MIDDLE = 0.5

Side = tuple[Node, bool]
"""A box and whether its left side is meant."""


def tracks_of(arrows: Sequence[Arrow], gutter: int) -> list[Track]:
    """The tracks in a gutter, from their column outward."""
    inside = [arrow for arrow in arrows if arrow.gutter == gutter and arrow.way in _OUTWARD]
    spans: dict[Track, float] = {}
    for arrow in inside:
        span = abs(_rank(arrow.source) - _rank(arrow.target))
        spans[arrow.track] = max(spans.get(arrow.track, 0.0), span)
    return sorted(spans, key=lambda track: (_OUTWARD[track.way], spans[track]))


class Places:
    """Where arrows meet the boxes: those that go up above those that go down, so that few cross."""

    def __init__(self, arrows: Sequence[Arrow]) -> None:
        wanted: dict[Side, dict[Hashable, float]] = {}
        for arrow in arrows:
            if arrow.way in (Way.ASIDE, Way.ACROSS):
                side = wanted.setdefault((arrow.source, arrow.leaves_left), {})
                side[arrow] = _rank(arrow.target)
            if arrow.way is not Way.DOWN:
                side = wanted.setdefault((arrow.target, arrow.enters_left), {})
                side[arrow.track] = _rank(arrow.source)
        self._order = {side: sorted(ends, key=lambda end: ends[end]) for side, ends in wanted.items()}

    @property
    def counts(self) -> Mapping[Node, int]:
        """The most arrows at either side of each box."""
        counts: dict[Node, int] = {}
        for (node, _), ends in self._order.items():
            counts[node] = max(counts.get(node, 0), len(ends))
        return counts

    def departure(self, arrow: Arrow) -> float:
        """Where an arrow leaves, as a share of the box's height from its top."""
        return self._share((arrow.source, arrow.leaves_left), arrow)

    def arrival(self, arrow: Arrow) -> float:
        """Where it arrives."""
        return self._share((arrow.target, arrow.enters_left), arrow.track)

    def _share(self, side: Side, end: Hashable) -> float:
        order = self._order[side]
        return (order.index(end) + 1) / (len(order) + 1)


def _rank(node: Node) -> float:
    """How far down its column a state stands, 0 to 1; a composite in the middle."""
    nodes = nodes_of(column_of(node))
    return nodes.index(node) / len(nodes) if node in nodes else MIDDLE
