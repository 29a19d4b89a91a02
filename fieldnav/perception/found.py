"""The rows that a finder found, sure or not."""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats, RowLine

LEAST_CONFIDENCE = 0.5
"""A row that is more likely wrong than right is not reported."""


@dataclass(frozen=True, slots=True)
class Found:
    """Rows from left to right.

    lines: straight ones, each with its confidence; paths_px: the same rows as curves, shape (rows, points,
    2), x and y in pixels from the upper edge of the ground to the lower edge.
    """

    lines: tuple[RowLine, ...]
    paths_px: Floats

    def sure(self) -> "Found":
        """Those worth reporting."""
        kept = [index for index, line in enumerate(self.lines) if line.confidence >= LEAST_CONFIDENCE]
        return Found(tuple(self.lines[index] for index in kept), self.paths_px[kept])


NO_ROWS = Found((), np.empty((0, 0, 2)))
