"""Two sequences of transitions aligned in order, so that as few as possible lack and the rest moved least."""

from collections.abc import Sequence
from difflib import SequenceMatcher
from typing import Protocol, TypeVar

import numpy as np

from fieldnav.messages import Floats

LACKING_M = 3.0
"""A transition that moved less than twice this far is the same one, else another. Our choice."""
MOST_CELLS = 4_000_000
"""Of the table of all pairs; longer sequences are aligned by what happened alone. Our choice: a second."""
UNKNOWN_M = 0.0


class Placed(Protocol):
    """What can be aligned: what happened, and how far on the way."""

    @property
    def key(self) -> tuple[str, str, str]: ...

    @property
    def way_m(self) -> float | None: ...


AnyPlaced = TypeVar("AnyPlaced", bound=Placed)
Pairs = list[tuple[AnyPlaced | None, AnyPlaced | None]]


def aligned(one: Sequence[AnyPlaced], other: Sequence[AnyPlaced]) -> Pairs[AnyPlaced]:
    """Pairs in order; None where one has nothing that stands for the other's."""
    if len(one) * len(other) > MOST_CELLS:
        return _by_what_happened(one, other)
    cost = _costs(one, other)
    pairs: Pairs[AnyPlaced] = []
    at, opposite = len(one), len(other)
    while at or opposite:
        here = cost[at, opposite]
        if at and opposite and here == cost[at - 1, opposite - 1] + _apart(one[at - 1], other[opposite - 1]):
            at, opposite = at - 1, opposite - 1
            pairs.append((one[at], other[opposite]))
        elif at and here == cost[at - 1, opposite] + LACKING_M:
            at -= 1
            pairs.append((one[at], None))
        else:
            opposite -= 1
            pairs.append((None, other[opposite]))
    return pairs[::-1]


def _costs(one: Sequence[AnyPlaced], other: Sequence[AnyPlaced]) -> Floats:
    """The least cost of aligning the first so many, shape (n + 1, m + 1): Needleman and Wunsch, 1970."""
    cost = np.zeros((len(one) + 1, len(other) + 1))
    cost[:, 0] = np.arange(len(one) + 1) * LACKING_M
    cost[0, :] = np.arange(len(other) + 1) * LACKING_M
    for at, each in enumerate(one, start=1):
        for opposite, its in enumerate(other, start=1):
            paired = cost[at - 1, opposite - 1] + _apart(each, its)
            alone = min(cost[at - 1, opposite], cost[at, opposite - 1]) + LACKING_M
            cost[at, opposite] = min(paired, alone)
    return cost


def _apart(one: Placed, other: Placed) -> float:
    """In metres; infinite for what is not the same."""
    if one.key != other.key:
        return float("inf")
    if one.way_m is None or other.way_m is None:
        return UNKNOWN_M
    return abs(one.way_m - other.way_m)


def _by_what_happened(one: Sequence[AnyPlaced], other: Sequence[AnyPlaced]) -> Pairs[AnyPlaced]:
    matcher = SequenceMatcher(None, [each.key for each in one], [each.key for each in other], autojunk=False)
    pairs: Pairs[AnyPlaced] = []
    at = opposite = 0
    for match in matcher.get_matching_blocks():
        pairs += [(each, None) for each in one[at : match.a]]
        pairs += [(None, each) for each in other[opposite : match.b]]
        at, opposite = match.a + match.size, match.b + match.size
        pairs += list(zip(one[match.a : at], other[match.b : opposite], strict=True))
    return pairs
