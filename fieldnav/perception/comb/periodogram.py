"""The coarse search: which comb of straight rows the bands of a picture are most in step with.

Only the fundamental is used, which makes the search over all directions a product of small matrices: the
spectrum of each band at the frequency that a spacing has there, turned by the phase that a direction brings.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import Bands, Complexes
from fieldnav.perception.comb.row_comb import LEAST_GROWTH, RowComb, growth, straight

FEWEST_ROWS_ACROSS = 1.0


@dataclass(frozen=True, eq=False)
class SearchRange:
    """The combs that are tried, every combination; see `row_comb.straight` for the parameters."""

    convergence: Floats
    rows_across: Floats
    vanishing: Floats
    bend: Floats
    candidates: int
    """How many spacings are followed up."""
    halved: bool
    """Whether a comb with half as many rows is tried beside each candidate: teeth have strong harmonics."""
    refined: int
    """How many of the combs that respond best are fitted, to compare them once more."""

    @cached_property
    def turns(self) -> tuple[tuple[Complexes, Complexes], ...]:
        """For each convergence the phases that undo leans, (f, b, bands), and bends, (f, c, bands)."""
        away = [1 / np.maximum(growth(float(each)), LEAST_GROWTH) - 1 for each in self.convergence]
        return tuple(
            (
                _turns(self.rows_across, self.vanishing[:, None] * off),
                _turns(self.rows_across, self.bend[:, None] * off**2),
            )
            for off in away
        )


def candidates(bands: Bands, tried: SearchRange) -> tuple[RowComb, ...]:
    """The combs that respond best, of different spacings, best first; none without vegetation."""
    if bands.empty:
        return ()
    energy = np.stack([energies(bands, tried, index) for index in range(len(tried.convergence))])
    best = energy.max(axis=(0, 2, 3))
    combs: list[RowComb] = []
    for chosen in _peaks(best, tried.candidates):
        q, b, c = np.unravel_index(int(energy[:, chosen].argmax()), energy[:, chosen].shape)
        for divisor in (1, 2) if tried.halved else (1,):
            across = float(tried.rows_across[chosen]) / divisor
            if across >= FEWEST_ROWS_ACROSS:
                comb = straight(
                    float(tried.convergence[q]), across, float(tried.vanishing[b]), float(tried.bend[c])
                )
                combs.append(comb.in_phase(bands))
    return tuple(sorted(combs, key=lambda comb: -comb.response(bands)))


def energies(bands: Bands, tried: SearchRange, index: int) -> Floats:
    """Magnitude of the fundamental for each spacing, direction and bend; shape (f, b, c)."""
    grown = growth(float(tried.convergence[index]))
    usable = grown > LEAST_GROWTH
    value = bands.at(tried.rows_across / np.maximum(grown, LEAST_GROWTH)[:, None]).T * usable
    lean, bend = tried.turns[index]
    return np.asarray(np.abs((value[:, None] * lean) @ bend.transpose(0, 2, 1)))


def _turns(rows_across: Floats, place: Floats) -> Complexes:
    """Phase factors that undo a displacement of so many widths at mid-height; shape (f, n, bands)."""
    return np.asarray(np.exp((2j * np.pi) * rows_across[:, None, None] * place).astype(np.complex64))


def _peaks(best: Floats, count: int) -> list[int]:
    """The strongest places of a curve, no two of them neighbours."""
    chosen: list[int] = []
    for place in np.argsort(-best, kind="stable").tolist():
        if all(abs(place - other) > 1 for other in chosen):
            chosen.append(place)
        if len(chosen) == count:
            break
    return chosen
