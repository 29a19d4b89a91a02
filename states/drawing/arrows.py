"""Which way each arrow of the picture goes, and where it meets the boxes."""

from dataclasses import dataclass
from enum import Enum

from states.drawing.boxes import LAST_COLUMN, Node, column_of, nodes_of
from states.names import Event
from states.table import LEAVES, TRANSITIONS


class Way(Enum):
    """How an arrow runs.

    DOWN to the box below; ASIDE along a track beside its own column; ACROSS to the neighbouring column along
    a track between them; LEVEL from a composite straight to the neighbouring column; AROUND below everything
    to the far column.
    """

    DOWN = "down"
    ASIDE = "aside"
    ACROSS = "across"
    LEVEL = "level"
    AROUND = "around"


@dataclass(frozen=True, slots=True)
class Track:
    """The line in a gutter that arrows of the same event to the same target share."""

    gutter: int
    event: Event
    target: Node
    way: Way


@dataclass(frozen=True, slots=True)
class Arrow:
    """One transition; `gutter` counts the spaces beside the columns from the left, -1 for none."""

    source: Node
    event: Event
    target: Node
    way: Way
    gutter: int

    @property
    def leaves_left(self) -> bool:
        """Whether it leaves the source's column to the left."""
        return self.gutter == column_of(self.source)

    @property
    def enters_left(self) -> bool:
        """Whether it comes to the target's column from the left."""
        return self.gutter == column_of(self.target)

    @property
    def track(self) -> Track:
        """Arrows of the same event to the same target share a track and the place where they arrive."""
        return Track(self.gutter, self.event, self.target, self.way)


def arrows() -> list[Arrow]:
    """The table's transitions, each with its way."""
    return [_arrow(row.source, row.event, row.target) for row in TRANSITIONS]


def _arrow(source: Node, event: Event, target: Node) -> Arrow:
    here, there = column_of(source), column_of(target)
    if abs(here - there) == LAST_COLUMN:
        return Arrow(source, event, target, Way.AROUND, 0 if there == 0 else LAST_COLUMN + 1)
    if here != there:
        way = Way.ACROSS if source in LEAVES else Way.LEVEL
        return Arrow(source, event, target, way, max(here, there))
    nodes = nodes_of(here)
    steps = nodes.index(target) - nodes.index(source)
    if steps == 1:
        return Arrow(source, event, target, Way.DOWN, -1)
    outer = {0: 0, LAST_COLUMN: LAST_COLUMN + 1}
    # In the middle column, what goes down does so on the left and what goes back on the right.
    return Arrow(source, event, target, Way.ASIDE, outer.get(here, here if steps > 0 else here + 1))
