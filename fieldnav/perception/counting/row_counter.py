"""Frame by frame across the rows: where the camera stands, and in the end which rows it has passed.

Some frames are kept as landmarks. A new frame is placed against the nearest of them, not against the one
before, so that standing still or driving back and forth adds up no error.
"""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats, Image, Side
from fieldnav.perception.comb.bands import Bands, bands_of
from fieldnav.perception.counting.levelled import level
from fieldnav.perception.counting.row_count import RowCount, count_rows
from fieldnav.perception.counting.row_map import map_of, rows_on
from fieldnav.perception.counting.settled_perspective import SettledPerspective
from fieldnav.perception.counting.sideways_shift import shift_between
from fieldnav.perception.vegetation import vegetation_of
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, Vegetation

APART = 0.1  # widths between landmarks: every place is seen from ten of them
LEAST_ALIKE = 0.3  # of two pictures, for their shift to be believed
MARGIN = 0.005  # of the row spacing: what standing still moves a row by


@dataclass(frozen=True, slots=True)
class _Placed:
    """A frame's vegetation and where the camera stood, in widths to the right of the first one."""

    bands: Bands
    place: float


class RowCounter:
    """Counts rows that pass sideways; neither the crop nor the camera need be known.

    camera: at the size of the frames.
    """

    def __init__(self, crop: CropProfile | None, camera: Pinhole | None) -> None:
        self._vegetation = crop.vegetation if crop else Vegetation()
        self._perspective = SettledPerspective(crop, camera)
        self._landmarks: list[_Placed] = []
        self._last: _Placed | None = None
        self._path: list[float] = []

    def add(self, image: Image) -> None:
        """Take in the next frame, shape (height, width, 3), uint8, blue green red."""
        cover = vegetation_of(image, self._vegetation)
        placed = self._placed(bands_of(cover.strength))
        self._path.append(np.nan if placed is None else placed.place)
        if placed is None:
            return
        self._last = placed
        if all(abs(placed.place - landmark.place) >= APART for landmark in self._landmarks):
            self._landmarks.append(placed)
            self._perspective.look(cover)

    @property
    def unplaced(self) -> tuple[int, ...]:
        """The frames that show nothing in common with those before; they are taken to lie between others."""
        return tuple(np.flatnonzero(np.isnan(self._path)).tolist())

    def result(self, direction: Side | None) -> RowCount:
        """What was counted so far; see `row_count.count_rows`."""
        path, spacing = _filled(np.array(self._path, float)), self._perspective.now.spacing
        if not self._landmarks:
            return count_rows(path, np.zeros(0), MARGIN * spacing, direction)
        pictures = ((each.place, level(each.bands, self._perspective.now)) for each in self._landmarks)
        strip = map_of(pictures, float(path.min()), float(path.max()))
        return count_rows(path, rows_on(strip, spacing), MARGIN * spacing, direction)

    def _placed(self, bands: Bands) -> _Placed | None:
        """The frame against the nearest landmark, or else against the frame before; None if like neither."""
        if bands.empty:
            return None
        last = self._last
        if last is None:
            return _Placed(bands, 0.0)
        nearest = min(self._landmarks, key=lambda landmark: abs(landmark.place - last.place))
        return self._beside(nearest, bands, last.place) or self._beside(last, bands, last.place)

    def _beside(self, known: _Placed, bands: Bands, expected: float) -> _Placed | None:
        perspective = self._perspective.now
        shift = shift_between(
            level(known.bands, perspective),
            level(bands, perspective),
            expected - known.place,
            perspective.spacing,
        )
        return _Placed(bands, known.place + shift.widths) if shift.likeness >= LEAST_ALIKE else None


def _filled(path: Floats) -> Floats:
    """A path whose gaps are bridged from the places before and after; zeros if it has nothing but gaps."""
    known = np.flatnonzero(~np.isnan(path))
    return np.interp(np.arange(len(path)), known, path[known]) if len(known) else np.zeros(len(path))
