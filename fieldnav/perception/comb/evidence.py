"""Both witnesses of rows in one map: where the network sees their middles, and vegetation near these."""

import cv2
import numpy as np

from fieldnav.perception.comb.bands import BAND_COUNT, COLUMNS, LEVEL, Bands
from fieldnav.perception.row_network import FULL, RowHeat

DIM, BRIGHT = 0.08, 0.78  # of the network's probability: what counts for nothing, and what counts in full
VEGETATION = 0.5  # what vegetation counts against the network; it is sharper, and everywhere
LUSH = 0.67  # strength of vegetation that counts in full
AROUND = (15, 3)  # columns and bands over which the network's word reaches to vegetation beside it
ALONE = 0.2  # share of its worth that vegetation has where the network sees nothing
ALMOST_NOTHING = 1e-6
FAR, NEAR = 0.12, 0.42
"""Shares of the height: what lies above the first counts for nothing, below the second in full: far rows are
too dense to be told apart, and often it is another field, a verge or the sky."""
_TRUST = np.clip((LEVEL + 0.5 - FAR) / (NEAR - FAR), 0, 1).astype(np.float32)[:, None]


def evidence_of(vegetation: Bands, heat: RowHeat) -> Bands:
    """The map that combs are fitted to, from the vegetation's bands and the network's picture."""
    seen = np.clip((network_bands(heat).strength - DIM) / (BRIGHT - DIM), 0, 1)
    about = np.asarray(cv2.blur(seen, AROUND), np.float32)
    about = ALONE + (1 - ALONE) * about / max(float(about.max()), ALMOST_NOTHING)
    green = np.minimum(vegetation.strength / LUSH, 1)
    return Bands(np.asarray((seen + VEGETATION * green * about) * _TRUST, np.float32), evenness=0.0)


def network_bands(heat: RowHeat) -> Bands:
    """The bands of what the network sees."""
    centres = heat.centres.astype(np.float32) / FULL
    wide = cv2.resize(centres, (COLUMNS, BAND_COUNT), interpolation=cv2.INTER_LINEAR)
    return Bands(np.asarray(wide, np.float32))
