"""The plants that stand in a field, as arrays."""

from dataclasses import dataclass, fields, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats

Integers = NDArray[np.int32]
NO_ROW = -1  # lane and row of a weed


@dataclass(frozen=True, slots=True)
class Stand:
    """Plants, one an entry of every array, all of shape (n,).

    x_m, y_m: where the plant stands, world coordinates; heading_rad: how it is turned about its stem;
    diameter_m, height_m: of its canopy; species: index into the plan's names; variant: which grown model;
    is_crop: crop or weed; lane, row: NO_ROW for weeds; sway_rad: phase of its movement in the wind.
    """

    x_m: Floats
    y_m: Floats
    heading_rad: Floats
    diameter_m: Floats
    height_m: Floats
    species: Integers
    variant: Integers
    is_crop: NDArray[np.bool_]
    lane: Integers
    row: Integers
    sway_rad: Floats

    def __len__(self) -> int:
        return len(self.x_m)

    def mirrored(self, rows_per_lane: int) -> Self:
        """The same plants with left and right exchanged; rows keep their order from right to left."""
        row = np.where(self.is_crop, rows_per_lane - 1 - self.row, self.row).astype(np.int32)
        return replace(self, y_m=-self.y_m, heading_rad=-self.heading_rad, row=row)

    @classmethod
    def joined(cls, stands: list["Stand"]) -> "Stand":
        """All plants of several stands, in order."""
        return Stand(*(np.concatenate([getattr(s, f.name) for s in stands]) for f in fields(cls)))
