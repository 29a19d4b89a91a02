"""A picture's vegetation as horizontal bands, and their spectra: what a search for periodic rows works on.

Positions across the picture are in picture widths from its middle column, to the right; a band's height is
its `level`, from -0.5 at the upper edge to 0.5 at the lower: nothing here depends on the picture's size.
"""

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import fft

from fieldnav.messages import Floats

BAND_COUNT = 48  # bands: a row that leans by one pixel a pixel moves by a fiftieth of the picture within one
COLUMNS = 320  # of a band: sixteen for each of twenty rows
BINS = 2048  # of the padded transform: six to a cycle, so that values between two can be interpolated
EVENNESS = 0.5  # power of a band's vegetation that it is divided by: near plants are large, far ones are many
LEAST_SHARE = 0.3  # of the mean band's vegetation that is added to it before

Complexes = NDArray[np.complex64]
LEVEL: Floats = (np.arange(BAND_COUNT) + 0.5) / BAND_COUNT - 0.5
"""Where the bands lie, shape (bands,)."""
STRETCHES: Floats = np.repeat(np.eye(6), BAND_COUNT // 6, axis=1)
"""Which bands each of six stretches of the height holds, shape (6, bands)."""
_MIDDLE = np.exp(2j * np.pi * np.arange(BINS // 2 + 1) * ((COLUMNS - 1) / 2) / BINS).astype(np.complex64)
_BAND = np.arange(BAND_COUNT)[:, None]


@dataclass(frozen=True)
class Bands:
    """strength: shape (bands, COLUMNS), float32, how much vegetation, 0 to 1, from the upper band down;
    evenness: how far near and far bands are made alike, 0 for not at all.
    """

    strength: NDArray[np.float32]
    evenness: float = EVENNESS

    @cached_property
    def even(self) -> NDArray[np.float32]:
        """The bands about their own means, near and far ones made alike; shape (bands, COLUMNS)."""
        mean = self.strength.mean(axis=1, keepdims=True)
        scale = mean + LEAST_SHARE * mean.mean() + np.finfo(np.float32).tiny
        return np.asarray((self.strength - mean) / scale**self.evenness, np.float32)

    @cached_property
    def spectrum(self) -> Complexes:
        """Fourier transforms of the even bands about their middles, shape (bands, BINS / 2 + 1)."""
        return np.asarray(fft.rfft(self.even, BINS, axis=1) * _MIDDLE, np.complex64)

    @cached_property
    def span(self) -> Floats:
        """The most that a template of unit mean square can respond with in each band, shape (bands,)."""
        return np.asarray(np.sqrt(COLUMNS * (self.even.astype(float) ** 2).sum(axis=1)))

    @property
    def empty(self) -> bool:
        """Whether nothing stands out."""
        return not self.span.any()

    def at(self, cycles: Floats) -> Complexes:
        """The spectrum at frequencies in cycles per picture width, shape (bands, n); 0 where it has none."""
        place = np.abs(cycles) * (BINS / COLUMNS)
        below = place.astype(np.int64)
        known = below < BINS // 2
        below = np.where(known, below, 0)
        share = (place - below).astype(np.float32)
        value = (1 - share) * self.spectrum[_BAND, below] + share * self.spectrum[_BAND, below + 1]
        return np.asarray(np.where(known, value, 0))

    def sample(self, place: Floats) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
        """Strength at positions in widths, shape (..., bands, n), and which of them lie in the picture."""
        column = (place + 0.5) * COLUMNS - 0.5
        left = np.floor(column).astype(np.int64)
        inside = (left >= 0) & (left < COLUMNS - 1)
        left = np.where(inside, left, 0)
        share = (column - left).astype(np.float32)
        flat = self.strength.ravel()
        index = left + _BAND * COLUMNS
        value = flat[index] + share * (flat[index + 1] - flat[index])
        return np.where(inside, value, np.float32(0)), inside


def bands_of(strength: NDArray[np.uint8]) -> Bands:
    """The bands of a picture of vegetation strength, shape (h, w), 0 to 255."""
    small = cv2.resize(strength, (COLUMNS, BAND_COUNT), interpolation=cv2.INTER_AREA)
    return Bands(np.asarray(small, np.float32) / np.float32(np.iinfo(np.uint8).max))
