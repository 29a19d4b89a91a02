"""Leaf colours: blue, green, red anchors from a species' darkest leaf to its palest rib.

Chosen by eye against outdoor photographs of field crops, in which sunlit leaves show green of 110 to 190
and red above blue; the wax on winter wheat greys it and brings its blue up near its red.
"""

from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

_ANCHORS: dict[str, tuple[tuple[int, int, int], ...]] = {
    "sugar-beet": ((30, 78, 40), (46, 118, 62), (66, 150, 92), (116, 184, 150)),
    "coriander": ((42, 98, 58), (58, 140, 84), (78, 172, 112), (118, 190, 150)),
    "potato": ((32, 76, 48), (50, 112, 72), (72, 146, 100), (104, 164, 130)),
    "beans": ((38, 92, 58), (56, 134, 86), (80, 168, 118), (118, 184, 150)),
    "lemon-balm": ((36, 94, 70), (50, 134, 104), (68, 166, 134), (96, 190, 166)),
    "maize": ((36, 92, 58), (50, 130, 84), (74, 162, 114), (124, 188, 156)),
    "soybean": ((44, 92, 62), (64, 130, 88), (88, 160, 118), (108, 162, 132)),
    "winter-wheat": ((64, 98, 70), (90, 140, 100), (112, 170, 126), (130, 184, 146)),
    "shepherds-purse": ((44, 86, 60), (62, 118, 82), (84, 146, 106), (96, 142, 128)),
    "chickweed": ((46, 106, 68), (62, 146, 92), (84, 176, 120), (110, 180, 140)),
    "meadow-grass": ((40, 100, 66), (58, 142, 98), (82, 176, 132), (112, 190, 156)),
    "fat-hen": ((62, 96, 66), (84, 126, 88), (112, 154, 118), (140, 180, 150)),
    "cleavers": ((38, 96, 60), (54, 130, 80), (76, 160, 106), (100, 170, 128)),
}


def _frozen(anchors: tuple[tuple[int, int, int], ...]) -> NDArray[np.uint8]:
    palette = np.array(anchors, dtype=np.uint8)
    palette.flags.writeable = False
    return palette


PALETTES = MappingProxyType({species: _frozen(anchors) for species, anchors in _ANCHORS.items()})
"""Palette of every species, uint8 (4, 3)."""

RIB_TONE = 1.0
"""Place in the palette of stalks and midribs."""
