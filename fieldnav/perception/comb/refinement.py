"""A comb fitted to the vegetation near its teeth: smooth curves for its middle and its spacing."""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import LEVEL, Bands
from fieldnav.perception.comb.row_comb import RowComb

REACH = 0.5  # of the spacing: what lies nearer to a tooth than to the next belongs to it
SAMPLES = 25  # across that
EDGE = 3  # samples on either side that show what lies between the rows
MEAN_SHIFT = 1.6  # a step towards the mean under a bell goes short by about this
DAMPING = 0.9
CENTRAL = 2.0  # spacings from the picture's middle at which a row counts two thirds: the robot drives there
ALMOST_NOTHING = 1e-9
ACROSS: Floats = np.linspace(-REACH, REACH, SAMPLES)
"""Where the samples lie beside a tooth, in spacings."""


@dataclass(frozen=True, slots=True)
class Stiffness:
    """How freely a comb may bend: degrees of the polynomials in height, and penalties on the higher ones.

    start, end: standard deviation of the bell about a tooth in the first and last round, in spacings.
    """

    middle_degree: int
    spacing_degree: int
    middle: float
    spacing: float
    start: float
    end: float
    rounds: int
    keep: float = 0.0
    """Weight of the spacing that the comb began with, against that of the picture."""


@dataclass(frozen=True, slots=True)
class Teeth:
    """The vegetation about every tooth.

    numbers: of the rows, shape (rows,); profile: strength across a tooth less what lies between the rows,
    shape (rows, bands, SAMPLES); whole: which teeth lie wholly in the picture, shape (rows, bands).
    """

    numbers: Floats
    profile: Floats
    whole: Floats


def teeth_of(comb: RowComb, bands: Bands, shift: Floats | float = 0.0) -> Teeth:
    """What stands about the comb's teeth; shift: rows' own displacements in spacings, shape (rows, bands)."""
    numbers = comb.numbers.astype(float)
    place = comb.middle + (numbers[:, None] + shift) * comb.spacing
    value, inside = bands.sample(place[:, :, None] + ACROSS * comb.spacing[:, None])
    between = np.minimum(value[:, :, :EDGE].mean(axis=-1), value[:, :, -EDGE:].mean(axis=-1))
    profile = np.maximum(value - between[:, :, None], 0)
    whole = (inside.mean(axis=-1) > 1 - EDGE / SAMPLES) & comb.usable
    return Teeth(numbers, profile.astype(float), whole.astype(float))


def off_centre(teeth: Teeth, width: float) -> tuple[Floats, Floats]:
    """How far the vegetation lies beside each tooth, in spacings, and with what weight; shape (rows, bands).

    width: standard deviation of the bell that weighs it. A tooth's weight saturates, so that lush plants
    count little more than ordinary ones.
    """
    bell = teeth.profile * np.exp(-0.5 * (ACROSS / width) ** 2)
    mass = bell.sum(axis=-1)
    off = MEAN_SHIFT * (bell * ACROSS).sum(axis=-1) / np.maximum(mass, ALMOST_NOTHING)
    mass = mass * teeth.whole
    usual = float(np.median(mass[mass > 0])) if (mass > 0).any() else 1.0
    return off, mass / (mass + usual)


def refine(comb: RowComb, bands: Bands, stiffness: Stiffness) -> RowComb:
    """The comb moved, widened and bent to where its vegetation is."""
    across, grown = _curves(stiffness.middle_degree), _curves(stiffness.spacing_degree)
    penalty = np.concatenate(
        [
            stiffness.middle * _roughness(stiffness.middle_degree),
            stiffness.spacing * _roughness(stiffness.spacing_degree),
        ]
    )
    shape = np.concatenate([_projected(across, comb.middle, comb), _projected(grown, comb.spacing, comb)])
    first = shape.copy()
    held = np.concatenate([np.zeros(across.shape[1]), np.full(grown.shape[1], stiffness.keep)])
    for width in np.linspace(stiffness.start, stiffness.end, stiffness.rounds):
        teeth = teeth_of(comb, bands)
        if not len(teeth.numbers):
            return comb
        off, weight = off_centre(teeth, float(width))
        place = comb.middle + teeth.numbers[:, None] * comb.spacing
        weight = weight * np.exp(-0.5 * (place / (CENTRAL * comb.spacing)) ** 2)
        middle = np.broadcast_to(across / comb.spacing[:, None], (len(teeth.numbers), *across.shape))
        spacing = teeth.numbers[:, None, None] * (grown / comb.spacing[:, None])
        design = np.concatenate([middle, spacing], axis=-1).reshape(-1, len(shape))
        weighted = design.T * weight.ravel()
        scale = weight.sum() / float(comb.spacing.mean()) ** 2 + ALMOST_NOTHING
        normal = weighted @ design + np.diag(scale * (penalty + held + ALMOST_NOTHING))
        pull = weighted @ off.ravel() - scale * (penalty * shape + held * (shape - first))
        shape = shape + DAMPING * np.linalg.solve(normal, pull)
        comb = RowComb(
            across @ shape[: across.shape[1]],
            np.maximum(grown @ shape[across.shape[1] :], comb.spacing / 2),
            comb.usable,
        )
    return comb


def _curves(degree: int) -> Floats:
    """Legendre polynomials over the bands, shape (bands, degree + 1)."""
    return np.asarray(legendre.legvander(2 * LEVEL, degree))


def _roughness(degree: int) -> Floats:
    """Penalties of the polynomials: none for straight lines, rising with the fourth power of the degree."""
    return np.asarray(np.maximum(np.arange(degree + 1) - 1.0, 0) ** 4)


def _projected(curves: Floats, values: Floats, comb: RowComb) -> Floats:
    weight = comb.usable.astype(float)[:, None]
    return np.asarray(np.linalg.lstsq(curves * weight, values * weight[:, 0], rcond=None)[0])
