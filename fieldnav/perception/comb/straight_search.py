"""Straight combs that a map of rows is most in step with: tried on a grid, then fitted freely."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import LEVEL, Bands
from fieldnav.perception.comb.periodogram import SearchRange, energies
from fieldnav.perception.comb.row_comb import LEAST_GROWTH, RowComb, straight

TRIED = SearchRange(
    convergence=np.concatenate([np.arange(0.0, 0.7, 0.1), np.arange(0.7, 2.0, 0.1)]),
    rows_across=np.linspace(1.3, 14, 52),
    vanishing=np.arange(-0.8, 0.81, 0.05),
    bend=np.zeros(1),
    candidates=40,
    halved=True,
    refined=3,
)
"""Every camera, from straight down to one that looks ahead, and rows up to half across."""
DIVISORS = (1, 2, 3)  # of the rows across: what a comb responds to may be one of its harmonics
LEAST_SPACING = 4.5 / 96  # of the width: cells of the network's picture
FEWEST_ACROSS, STEEPEST, MOST_CONVERGENCE, LEAST_CONVERGENCE = 1.2, 1.5, 2.1, 0.02
OUTSIDE = 10.0  # penalty on the square of what a parameter lies beyond these
FIRST_STEPS = np.array([0.08, 0.05, 0.03, 0.1])  # of the four parameters
ROUNDS, CLOSE, AS_GOOD = 110, 1e-3, 1e-4


@dataclass(frozen=True, slots=True)
class FittedComb:
    """A straight comb and how well the map follows it, -1 to 1."""

    comb: RowComb
    response: float


def straight_combs(bands: Bands) -> list[FittedComb]:
    """The best straight combs, best first, not all different; none for an empty map."""
    if bands.empty:
        return []
    starts = sorted(_on_grid(bands), key=lambda comb: -comb.response(bands))[: TRIED.refined]
    return sorted((fitted(comb, bands) for comb in starts), key=lambda each: -each.response)


def fitted(comb: RowComb, bands: Bands) -> FittedComb:
    """The straight comb near this one that the map follows best (Nelder and Mead's simplex)."""
    first = _parameters(comb)
    found = minimize(
        lambda values: _outside(values) - _comb(values).response(bands),
        first,
        method="Nelder-Mead",
        options={
            "initial_simplex": np.vstack([first, first + np.diag(FIRST_STEPS)]),
            "maxiter": ROUNDS,
            "xatol": CLOSE,
            "fatol": AS_GOOD,
        },
    )
    best = _comb(found.x) if _comb(found.x).usable.any() else comb
    return FittedComb(best, best.response(bands))


def _on_grid(bands: Bands) -> list[RowComb]:
    """Combs at the highest places of the grid over convergence and rows across, no two of them neighbours."""
    energy = np.stack([energies(bands, TRIED, index)[:, :, 0] for index in range(len(TRIED.convergence))])
    best, direction = energy.max(axis=2), energy.argmax(axis=2)
    taken = np.zeros_like(best, dtype=bool)
    combs: list[RowComb] = []
    for place in np.argsort(-best, axis=None, kind="stable"):
        q, f = np.unravel_index(int(place), best.shape)
        if taken[q, f]:
            continue
        taken[max(0, q - 1) : q + 2, max(0, f - 1) : f + 2] = True
        for divisor in DIVISORS:
            across = float(TRIED.rows_across[f]) / divisor
            if across >= TRIED.rows_across[0]:
                lean = float(TRIED.vanishing[direction[q, f]])
                comb = straight(float(TRIED.convergence[q]), across, lean, least_spacing=LEAST_SPACING)
                combs.append(comb.in_phase(bands))
        if len(combs) >= TRIED.candidates:
            break
    return combs


def _parameters(comb: RowComb) -> Floats:
    """Convergence, logarithm of the rows across, vanishing point and phase of the nearest straight comb."""
    slope, middle = np.polyfit(LEVEL[comb.usable], comb.spacing[comb.usable], 1)
    grown = 1 + slope / middle * LEVEL
    seen = comb.usable & (grown > LEAST_GROWTH)
    basis = np.stack([grown, 1 - grown], axis=-1)[seen]
    place, vanishing = np.linalg.lstsq(basis, comb.middle[seen], rcond=None)[0]
    return np.array([slope / middle, -np.log(middle), vanishing, place / middle])


def _comb(values: Floats) -> RowComb:
    convergence, across, vanishing, phase = (float(value) for value in values)
    comb = straight(convergence, float(np.exp(across)), vanishing, least_spacing=LEAST_SPACING)
    return RowComb(comb.middle + phase * comb.spacing, comb.spacing, comb.usable)


def _outside(values: Floats) -> float:
    convergence, across, vanishing, _ = values
    beyond = (
        LEAST_CONVERGENCE - convergence,
        convergence - MOST_CONVERGENCE,
        np.log(FEWEST_ACROSS) - across,
        abs(vanishing) - STEEPEST,
    )
    return OUTSIDE * float(sum(max(0.0, each) ** 2 for each in beyond))
