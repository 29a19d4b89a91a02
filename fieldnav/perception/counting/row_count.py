"""Rows counted as they pass the middle of the picture sideways; one that goes back is taken off again.

All rows move together: `path` is where the camera stands in each frame, `places` where the rows run, both in
widths to the right of where it began. A row that the camera has passed lies left of the picture's middle.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats, Side


@dataclass(frozen=True, slots=True)
class Passage:
    """A row that passes the middle; frame: the first one in which it lies beyond, until it turns back.

    row: from left to right; moved: the way that the robot moves against it.
    """

    frame: int
    row: int
    moved: Side


@dataclass(frozen=True, slots=True)
class RowCount:
    """Every passage in its order, and the way that counts up."""

    passages: tuple[Passage, ...]
    direction: Side

    @property
    def rows_crossed(self) -> int:
        """Rows passed in the direction, less those passed the other way."""
        return sum(self.step(passage) for passage in self.passages)

    @property
    def frames(self) -> tuple[int, ...]:
        """The frames of the passages that still count: one that was undone is taken off with its undoing."""
        standing: list[Passage] = []
        for passage in self.passages:
            if standing and standing[-1].moved is not passage.moved:
                standing.pop()
            else:
                standing.append(passage)
        return tuple(passage.frame for passage in standing)

    def step(self, passage: Passage) -> int:
        """1 for a passage that counts up, -1 for one that counts down."""
        return 1 if passage.moved is self.direction else -1


def count_rows(path: Floats, places: Floats, margin: float, direction: Side | None) -> RowCount:
    """Count rows at places, shape (rows,), from a path, shape (frames,).

    margin: how far beyond the middle a row must come to have passed, so that one that trembles there passes
    once; a row within it in the first frame belongs to the side it leaves for. direction: None for the one
    that the robot moved in on the whole.
    """
    passages = [
        passage for row, place in enumerate(places) for passage in passages_of(place - path, row, margin)
    ]
    passages.sort(key=lambda passage: passage.frame)
    return RowCount(tuple(passages), direction or _net(passages))


def _net(passages: Sequence[Passage]) -> Side:
    lefts = sum(passage.moved is Side.LEFT for passage in passages)
    return Side.LEFT if 2 * lefts > len(passages) else Side.RIGHT


def passages_of(beside: Floats, row: int, margin: float) -> list[Passage]:
    """The passages of one row; beside: how far right of the middle it lies in each frame, shape (frames,)."""
    clear = np.flatnonzero(np.abs(beside) > margin)
    sides = np.sign(beside[clear])
    return [
        Passage(_first_beyond(beside, int(clear[turn]), side), row, Side.RIGHT if side < 0 else Side.LEFT)
        for turn, side in ((turn, sides[turn]) for turn in np.flatnonzero(np.diff(sides)) + 1)
    ]


def _first_beyond(beside: Floats, frame: int, side: float) -> int:
    """The frame since which a row has been on a side."""
    before = np.flatnonzero(np.sign(beside[:frame]) != side)
    return int(before[-1]) + 1
