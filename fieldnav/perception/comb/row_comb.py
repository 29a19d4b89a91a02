"""Parallel rows as a comb in the picture: where its teeth pass through each band.

A plane seen by a camera without roll: the distance between rows grows linearly from the horizon down. With w
the growth, 1 at mid-height, a straight row runs at a w + b (1 - w): a where it passes mid-height, b the
vanishing point; a bend of the field adds c (1 - w)^2 / w.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import BAND_COUNT, LEVEL, STRETCHES, Bands

HARMONICS = np.arange(1, 7)
TOOTH = 0.12  # of the spacing: standard deviation of the template's tooth
_STRENGTH = np.exp(-2 * (np.pi * HARMONICS * TOOTH) ** 2)
TEMPLATE: Floats = _STRENGTH / np.sqrt((_STRENGTH**2).sum() / 2)
"""Fourier coefficients of a row of teeth about its mean, of unit mean square."""
PHASES = 48  # at which the comb is tried
LEAST_GROWTH = 0.06  # nearer to the horizon rows cannot be told apart
LEAST_SPACING = 1 / 80  # of the picture's width: four columns of a band
LEAST_SEEN = 0.25  # of the bands that a row must pass
LEAST_USABLE = 5  # bands of a stretch
ALMOST_NOTHING = 1e-9


@dataclass(frozen=True)
class RowComb:
    """The rows in each band, in picture widths: row k lies at middle + k spacing; arrays of shape (bands,).

    usable: the bands below the horizon whose rows can be told apart.
    """

    middle: Floats
    spacing: Floats
    usable: NDArray[np.bool_]

    @cached_property
    def numbers(self) -> NDArray[np.int64]:
        """The rows that pass through enough of the picture, from left to right."""
        reach = int(1 / float(self.spacing[self.usable].min())) + 1 if self.usable.any() else 0
        number = np.arange(-reach, reach + 1)
        place = self.middle + number[:, None] * self.spacing
        seen = ((np.abs(place) < 1 / 2) & self.usable).sum(axis=1)
        return np.asarray(number[seen >= LEAST_SEEN * BAND_COUNT])

    def response(self, bands: Bands) -> float:
        """How well the vegetation follows the comb: its correlation with a row of teeth, -1 to 1."""
        return float(self._responses(bands).sum() / max(bands.span.sum(), ALMOST_NOTHING))

    def weakest_response(self, bands: Bands) -> float:
        """The same of the two weakest stretches of the height: rows go on, chance does not."""
        usable = STRETCHES @ self.usable >= LEAST_USABLE
        span = STRETCHES @ bands.span
        each = np.sort((STRETCHES @ self._responses(bands) / np.maximum(span, ALMOST_NOTHING))[usable])
        return float(each[:2].mean()) if len(each) else 0.0

    def in_phase(self, bands: Bands) -> "RowComb":
        """The comb moved sideways, by less than its spacing, to where it responds best."""
        phase = np.arange(PHASES) / PHASES
        turned = np.exp(2j * np.pi * phase[:, None] * HARMONICS)
        score = (turned * (TEMPLATE * self._harmonics(bands).sum(axis=0))).real.sum(axis=1)
        shift = phase[int(score.argmax())]
        return RowComb(self.middle + shift * self.spacing, self.spacing, self.usable)

    def _responses(self, bands: Bands) -> Floats:
        """Each band's response, shape (bands,)."""
        return np.asarray((TEMPLATE * self._harmonics(bands).real).sum(axis=1))

    def _harmonics(self, bands: Bands) -> NDArray[np.complex128]:
        """The bands' spectra at the comb's harmonics, in the comb's phase; shape (bands, harmonics)."""
        cycles = HARMONICS / self.spacing[:, None]
        phase = np.exp(2j * np.pi * HARMONICS * (self.middle / self.spacing)[:, None])
        return np.asarray(bands.at(cycles) * phase * self.usable[:, None])


def growth(convergence: float) -> Floats:
    """How wide the ground is drawn in each band against mid-height; shape (bands,).

    convergence: height of the picture over the distance from its mid-height up to the horizon.
    """
    return 1 + convergence * LEVEL


def straight(
    convergence: float,
    rows_across: float,
    vanishing: float,
    bend: float = 0.0,
    least_spacing: float = LEAST_SPACING,
) -> RowComb:
    """The comb of straight or evenly bent rows, row 0 through the middle of the picture.

    rows_across: how many spacings fit into the width at mid-height; vanishing: where the rows meet on the
    horizon, and bend: see the module; both in widths. least_spacing: of rows that can be told apart.
    """
    grown = growth(convergence)
    usable = grown > LEAST_GROWTH
    grown = np.maximum(grown, LEAST_GROWTH)
    spacing = grown / rows_across
    middle = vanishing * (1 - grown) + bend * (1 - grown) ** 2 / grown
    return RowComb(middle, spacing, usable & (spacing > least_spacing))
