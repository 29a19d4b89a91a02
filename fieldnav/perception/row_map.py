"""The rows of a strip of ground that was crossed sideways: pictures laid side by side, rows as their ridges."""

from collections.abc import Iterable

import numpy as np
from scipy.ndimage import gaussian_filter1d, maximum_filter1d
from scipy.signal import find_peaks

from fieldnav.messages import Floats
from fieldnav.perception.bands import COUNT
from fieldnav.perception.levelled import PLACES, STEP, Levelled

SMOOTH = 0.06  # of the row spacing: standard deviation of the blur across the rows, half a narrow canopy
NEAREST = 0.4  # row spacings between two rows; sowing errs by less, and a spacing may be taken too large
SEPARATE = 0.5  # of a row's vegetation, that the ground on both sides of it must lie below
CONTRAST = 0.4  # of a row against the ground halfway to its neighbours, 0 to 1
NOTHING = 0.02  # strength that is added before a contrast is taken
PLANT = 0.05  # strength from which on a band shows a plant
COVERED = 0.25  # of a row's length that must show plants; a weed covers less
THINNEST = 0.2  # of the densest row's vegetation, that the thinnest has


class RowMap:
    """Mean vegetation of the ground about the places from `first` to `last`, in widths."""

    def __init__(self, first: float, last: float) -> None:
        self._start = round((first - 1) / STEP) * STEP
        columns = round((last + 1 - self._start) / STEP) + 1
        self._sum: Floats = np.zeros((COUNT, columns))
        self._seen: Floats = np.zeros((COUNT, columns))
        self.places: Floats = self._start + STEP * np.arange(columns)

    def lay(self, picture: Levelled, place: float) -> None:
        """Add a picture taken at a place between the first and the last."""
        first = round((place + PLACES[0] - self._start) / STEP)
        columns = slice(first, first + len(PLACES))
        self._sum[:, columns] += picture.strength
        self._seen[:, columns] += picture.seen

    @property
    def strength(self) -> Floats:
        """Shape (COUNT, n), at `places`; 0 where nothing was seen."""
        return np.asarray(self._sum / np.maximum(self._seen, 1))


def map_of(pictures: Iterable[tuple[float, Levelled]], first: float, last: float) -> RowMap:
    """Pictures, each with the place that it was taken at, all within first and last."""
    strip = RowMap(first, last)
    for place, picture in pictures:
        strip.lay(picture, place)
    return strip


def rows_on(strip: RowMap, spacing: float) -> Floats:
    """Where the rows run at mid-height, from left to right, in widths; spacing: roughly, in widths."""
    strength = strip.strength
    # The root makes many small plants count more than one large weed.
    ridge = gaussian_filter1d(np.sqrt(strength).mean(axis=0), SMOOTH * spacing / STEP, mode="constant")
    peaks, _ = find_peaks(ridge, distance=max(1.0, NEAREST * spacing / STEP))
    half = max(1, round(spacing / 2 / STEP))
    between = np.array([_between(ridge, int(peak), half) for peak in peaks]).reshape(-1, 2)
    contrast = (ridge[peaks] - between.mean(axis=1)) / (ridge[peaks] + between.mean(axis=1) + NOTHING)
    near = maximum_filter1d(strength, 2 * round(SMOOTH * spacing / STEP) + 1, axis=1)[:, peaks]
    covered = (near > PLANT).mean(axis=0)
    sure = (contrast >= CONTRAST) & (covered >= COVERED) & (between.max(axis=1) < SEPARATE * ridge[peaks])
    densest = float(ridge[peaks][sure].max(initial=0.0))
    found = peaks[sure & (ridge[peaks] >= THINNEST * densest)]
    return np.asarray(strip.places[found])


def _between(ridge: Floats, peak: int, half: int) -> tuple[float, float]:
    """The least vegetation within half a spacing to the left and to the right."""
    return float(ridge[max(0, peak - half) : peak + 1].min()), float(ridge[peak : peak + half + 1].min())
