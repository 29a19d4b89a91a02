"""Where the states' boxes stand: a column for each direction of travel, the other states between them."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

from fieldnav.messages import Direction
from states.names import Path

WIDTH, PADDING, TITLE = 132.0, 14.0, 22.0
"""Of a leaf's box; between a composite's border and what is in it; height of a composite's name."""
GAP = 40.0
"""Between leaves one above the other: room for an arrow and its event."""
PORT = 15.0
"""Between arrows that meet the same side of a box: a line of writing."""
LEAST_HEIGHT = 38.0
DEPTH = 3
"""Composites are nested twice at most, a leaf being the third."""


@dataclass(frozen=True, slots=True)
class Box:
    """A state's box in the picture's units; `leaf` is false for composites."""

    path: Path
    column: int
    left: float
    top: float
    right: float
    bottom: float
    leaf: bool = True

    @property
    def middle(self) -> float:
        return (self.left + self.right) / 2


def column_of(path: Path) -> int:
    """0 for the states of driving forward, 2 for backward, 1 for the others."""
    return {Direction.FORWARD: 0, Direction.BACKWARD: 2}.get(path[0], 1)  # type: ignore[call-overload]
