"""The rows of a strip of ground that was crossed sideways: pictures laid side by side, rows their ridges."""

from collections.abc import Iterable

import numpy as np
from scipy.ndimage import gaussian_filter1d, maximum_filter1d
from scipy.signal import find_peaks, peak_prominences

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import BAND_COUNT
from fieldnav.perception.counting.levelled import PLACES, STEP, Levelled

SMOOTH = 0.06  # of the row spacing: standard deviation of the blur across the rows, half a narrow canopy
NEAREST = 0.4  # row spacings between two rows; sowing errs by less, and a spacing may be taken too large
SEPARATE = 0.5  # of a row's vegetation, by which it stands out from any denser row beside it
CONTRAST = 0.4  # of a row against the ground halfway to its neighbours, 0 to 1
LEAST = 0.085  # vegetation of a row times its contrast; scattered weeds of 5 cm in line have less
NOTHING = 0.02  # strength that is added before a contrast is taken
PLANT = 0.05  # strength from which on a band shows a plant
COVERED = 0.2  # of a row's length that must show plants; a weed covers less
THINNEST = 0.2  # of the densest row's vegetation, that the thinnest has


class RowMap:
    """Mean vegetation of the ground about the places from `first` to `last`, in widths."""

    def __init__(self, first: float, last: float) -> None:
        self._start = round((first - 1) / STEP) * STEP
        columns = round((last + 1 - self._start) / STEP) + 1
        self._sum: Floats = np.zeros((BAND_COUNT, columns))
        self._seen: Floats = np.zeros((BAND_COUNT, columns))
        self.places: Floats = np.asarray(self._start + STEP * np.arange(columns), float)

    def lay(self, picture: Levelled, place: float) -> None:
        """Add a picture taken at a place between the first and the last."""
        first = round((place + PLACES[0] - self._start) / STEP)
        columns = slice(first, first + len(PLACES))
        self._sum[:, columns] += picture.strength
        self._seen[:, columns] += picture.seen

    @property
    def strength(self) -> Floats:
        """Shape (bands, n), at `places`; 0 where nothing was seen."""
        return np.asarray(self._sum / np.maximum(self._seen, 1))


def map_of(pictures: Iterable[tuple[float, Levelled]], first: float, last: float) -> RowMap:
    """Pictures, each with the place that it was taken at, all within first and last."""
    strip = RowMap(first, last)
    for place, picture in pictures:
        strip.lay(picture, place)
    return strip


def rows_on(strip: RowMap, spacing: float) -> Floats:
    """Where the rows run at mid-height, from left to right, in widths; spacing: roughly, in widths."""
    strength, blur = strip.strength, SMOOTH * spacing / STEP
    # The root makes many small plants count more than one large weed.
    ridge = gaussian_filter1d(np.sqrt(strength).mean(axis=0), blur, mode="constant")
    peaks, _ = find_peaks(ridge, distance=max(1.0, NEAREST * spacing / STEP))
    half = max(1, round(spacing / 2 / STEP))
    beside = np.array([_beside(ridge, int(peak), half) for peak in peaks]).reshape(-1, 2)
    on, between = ridge[peaks], beside.mean(axis=1)
    contrast = (on - between) / (on + between + NOTHING)
    covered = (maximum_filter1d(strength, 2 * round(blur) + 1, axis=1)[:, peaks] > PLANT).mean(axis=0)
    sure = (contrast >= CONTRAST) & (on * contrast >= LEAST) & (covered >= COVERED)
    sure &= peak_prominences(ridge, peaks)[0] >= SEPARATE * on
    densest = float(on[sure].max(initial=0.0))
    return np.asarray(strip.places[peaks[sure & (on >= THINNEST * densest)]])


def _beside(ridge: Floats, peak: int, half: int) -> tuple[float, float]:
    """The least vegetation within half a spacing to the left and to the right."""
    return float(ridge[max(0, peak - half) : peak + 1].min()), float(ridge[peak : peak + half + 1].min())
