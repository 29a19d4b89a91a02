"""The rows of a strip of ground that was crossed sideways: pictures laid side by side, rows their ridges."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, maximum_filter1d
from scipy.signal import find_peaks, peak_prominences

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import BAND_COUNT
from fieldnav.perception.counting.levelled import PLACES, STEP, Levelled

SMOOTH = 0.06  # of the row spacing: standard deviation of the blur across the rows, half a narrow canopy
NEAREST = 0.4  # row spacings between two rows; sowing errs by less, and a spacing may be taken too large
PLANT = 0.05  # strength from which on a band shows a plant; straw, stones and compression's colours have less
PALE = 0.1  # of a row's greenest plant, that its palest has
SEPARATE = 0.5  # of a row's vegetation, by which it stands out from any denser row beside it
MIN_CONTRAST = 0.55  # of a row against the ground halfway to its neighbours, 0 to 1
NOTHING = 0.02  # strength that is added before a contrast is taken
MIN_VEGETATION = 0.085  # of a row, times its contrast; scattered weeds of 5 cm in line have less
MIN_REACH = 0.45  # of the picture's height, from a row's first plant to its last; a tuft reaches less far
MIN_SHARE = 0.2  # of the densest row's vegetation, that every row has

IN_LINE = 0.04  # row spacings, rms, that drilled plants stand beside their line: 1.4 cm of 0.35 m; weeds more
CORRIDOR = 0.15  # row spacings to either side of a line, within which the plants are its own
MIN_SPARSE = 0.035  # vegetation, times its contrast, of a row of few or small plants that keep in line
MIN_SPARSE_COVERED = 0.35  # of such a row's length that must show plants

BESIDE = 0.12  # of the distance between rows, by which a row is off its place beside another
MIN_ROWS = 2  # that show their distance
MIN_SHARE_BESIDE = 0.1  # of the densest row's vegetation, that plants in line have where a row belongs


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
    ridges = _ridges(strip, spacing)
    places = np.asarray(strip.places[ridges.peaks])
    sure = ridges.stand_out & ((ridges.are_dense & ridges.reach_far) | ridges.are_sparse)
    share = ridges.on / max(float(ridges.on[sure].max(initial=0.0)), NOTHING)
    sure &= share >= MIN_SHARE
    # Three plants, or what a gap leaves of a row, are a row only where the next one belongs.
    few = ridges.stand_out & ridges.are_in_line & (ridges.are_dense | ridges.are_few)
    few &= share >= MIN_SHARE_BESIDE
    return np.asarray(places[sure | (few & _beside_rows(places, places[sure]))])


def _beside_rows(places: Floats, rows: Floats) -> NDArray[np.bool_]:
    """Whether places, shape (n,), lie as far from a row as the nearest two rows lie from each other."""
    if len(rows) < MIN_ROWS:
        return np.zeros(len(places), bool)
    away = np.abs(places[:, None] - rows) / np.diff(rows).min()
    return np.asarray((np.abs(away - 1) <= BESIDE).any(axis=1))


@dataclass(frozen=True, slots=True)
class _Ridges:
    """Where vegetation is densest across the strip; every array of shape (ridges,) but plants.

    peaks: columns of the strip; on: vegetation there; contrast: against the ground beside, 0 to 1;
    prominence: by how much it stands out, 0 to 1; plants: shape (bands, ridges), whether a band shows a plant
    there; scatter: rms distance of the plants from the line, in row spacings.
    """

    peaks: NDArray[np.int64]
    on: Floats
    contrast: Floats
    prominence: Floats
    plants: NDArray[np.bool_]
    scatter: Floats

    @property
    def covered(self) -> Floats:
        return np.asarray(self.plants.mean(axis=0))

    @property
    def stand_out(self) -> NDArray[np.bool_]:
        """Whether the ground to either side is emptier."""
        return np.asarray((self.contrast >= MIN_CONTRAST) & (self.prominence >= SEPARATE))

    @property
    def reach_far(self) -> NDArray[np.bool_]:
        """Whether plants stand along the line, not in one place."""
        length = len(self.plants) - self.plants.argmax(axis=0) - self.plants[::-1].argmax(axis=0)
        return np.asarray(self.plants.any(axis=0) & (length >= MIN_REACH * len(self.plants)))

    @property
    def are_dense(self) -> NDArray[np.bool_]:
        return np.asarray(self.on * self.contrast >= MIN_VEGETATION)

    @property
    def are_sparse(self) -> NDArray[np.bool_]:
        """Whether few or small plants keep in line as drilled ones do, over much of the height."""
        return np.asarray(self.are_few & self.are_in_line & (self.covered >= MIN_SPARSE_COVERED))

    @property
    def are_few(self) -> NDArray[np.bool_]:
        """Whether there are at least a few plants, apart from each other."""
        return np.asarray((self.on * self.contrast >= MIN_SPARSE) & self.reach_far)

    @property
    def are_in_line(self) -> NDArray[np.bool_]:
        return np.asarray(self.scatter <= IN_LINE)


def _ridges(strip: RowMap, spacing: float) -> _Ridges:
    strength, blur = strip.strength, SMOOTH * spacing / STEP
    plants = np.maximum(strength - PLANT, 0)
    # The root makes many small plants count more than one large weed, but would make haze count as much.
    ridge = gaussian_filter1d(np.sqrt(plants).mean(axis=0), blur, mode="constant")
    peaks, _ = find_peaks(ridge, distance=max(1.0, NEAREST * spacing / STEP))
    half = max(1, round(spacing / 2 / STEP))
    between = np.array([_beside(ridge, int(peak), half) for peak in peaks]).reshape(-1, 2).mean(axis=1)
    on = ridge[peaks]
    near = maximum_filter1d(strength, 2 * round(blur) + 1, axis=1)[:, peaks]
    shown = near > np.maximum(PLANT, PALE * near.max(axis=0, initial=0.0))
    reach = max(1, round(CORRIDOR * spacing / STEP))
    scatter = np.array([_scatter(plants, int(peak), reach) for peak in peaks], float) * STEP / spacing
    contrast = (on - between) / (on + between + NOTHING)
    prominence = peak_prominences(ridge, peaks)[0] / np.maximum(on, np.finfo(float).tiny)
    return _Ridges(peaks, on, contrast, prominence, shown, scatter)


def _beside(ridge: Floats, peak: int, half: int) -> tuple[float, float]:
    """The least vegetation within half a spacing to the left and to the right."""
    return float(ridge[max(0, peak - half) : peak + 1].min()), float(ridge[peak : peak + half + 1].min())


def _scatter(plants: Floats, peak: int, reach: int) -> float:
    """Rms distance in columns of the bands' plants from a line, each band by the root of what it shows."""
    first = max(0, peak - reach)
    near = plants[:, first : peak + reach + 1]
    shown = near.sum(axis=1)
    middle = near @ (first + np.arange(near.shape[1]) - peak) / np.maximum(shown, np.finfo(float).tiny)
    weight = np.sqrt(shown)
    return float(np.sqrt((weight * middle**2).sum() / max(weight.sum(), np.finfo(float).tiny)))
