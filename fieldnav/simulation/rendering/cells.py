"""The grid of square cells that ground and foliage are prepared in, a cell at a time."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from fieldnav.messages import Floats
from fieldnav.simulation.texture import PIXEL_M

CELL_PIXELS = 320
CELL_M = CELL_PIXELS * PIXEL_M  # 0.4 m

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class Block(NamedTuple):
    """A rectangle of cells: the first in x and y, and one past the last."""

    first_x: int
    first_y: int
    past_x: int
    past_y: int

    @classmethod
    def around(cls, lower_m: Floats, upper_m: Floats) -> "Block":
        """The cells that touch the box between two world points (2,)."""
        first = np.floor(lower_m / CELL_M).astype(int)
        past = np.floor(upper_m / CELL_M).astype(int) + 1
        return cls(int(first[0]), int(first[1]), int(past[0]), int(past[1]))

    def cells(self) -> list[tuple[int, int]]:
        """All cells, in order."""
        return [(x, y) for x in range(self.first_x, self.past_x) for y in range(self.first_y, self.past_y)]


class Kept(Generic[Key, Value]):
    """Values made on demand, the last used ones kept; what is made depends on the key alone."""

    def __init__(self, make: Callable[[Key], Value], most: int) -> None:
        self._make = make
        self._most = most
        self._values: OrderedDict[Key, Value] = OrderedDict()

    def __getitem__(self, key: Key) -> Value:
        if key in self._values:
            self._values.move_to_end(key)
            return self._values[key]
        value = self._values[key] = self._make(key)
        if len(self._values) > self._most:
            self._values.popitem(last=False)
        return value
