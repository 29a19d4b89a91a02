"""The comb finder: the parallel rows that explain the vegetation best together, then each by itself."""

import numpy as np

from fieldnav.messages import Floats, RowLine
from fieldnav.perception.comb.bands import LEVEL, Bands
from fieldnav.perception.comb.confidence import confidence_of
from fieldnav.perception.comb.periodogram import SearchRange, candidates
from fieldnav.perception.comb.refinement import Stiffness, refine
from fieldnav.perception.comb.row_comb import RowComb
from fieldnav.perception.comb.rows import CombRows, rows_of
from fieldnav.perception.found import Found
from fieldnav.perception.vegetation import Cover

STEEP_VIEW = Stiffness(1, 1, middle=1.0, spacing=1.0, start=0.25, end=0.12, rounds=4, keep=0.1)
"""A camera that looks down sees a metre or two of the rows: they are straight there."""
OBLIQUE_VIEW = (
    Stiffness(6, 2, middle=0.006, spacing=0.6, start=0.3, end=0.25, rounds=4),
    Stiffness(6, 2, middle=0.001, spacing=0.1, start=0.2, end=0.1, rounds=6),
)
"""One that looks ahead sees bends and hills."""
STEEP_SCATTER, OBLIQUE_SCATTER = 0.25, 1.0  # of a row's vegetation, in spacings; see `rows.rows_of`
OBLIQUE = 0.8  # convergence from which on a view is one that looks ahead


def find_comb(bands: Bands, tried: SearchRange) -> RowComb | None:
    """The comb that fits the bands best among those tried; None where nothing stands out."""
    combs = [refined(comb, bands) for comb in candidates(bands, tried)[: tried.refined]]
    return max(combs, key=lambda comb: comb.response(bands), default=None)


def rows_in(comb: RowComb, bands: Bands, cover: Cover) -> Found:
    """Every row of a comb, whether plants bear it out or not: its confidence tells."""
    rows = rows_of(comb, bands, scatter_of(comb))
    curves = curves_px(rows, cover)
    confidence = confidence_of(rows, comb, bands)
    lines = tuple(
        RowLine(float(top), float(bottom), float(sure))
        for (top, bottom), sure in zip(_ends_px(rows, comb, cover), confidence, strict=True)
    )
    return Found(lines, curves)


def convergence_of(comb: RowComb) -> float:
    """How fast the rows run together: the picture's height over the horizon's distance from its middle."""
    slope, middle = np.polyfit(LEVEL[comb.usable], comb.spacing[comb.usable], 1)
    return float(slope / middle)


def scatter_of(comb: RowComb) -> float:
    """How far a tooth's vegetation lies about its row in such a view, in spacings; see `rows.rows_of`."""
    return STEEP_SCATTER if convergence_of(comb) < OBLIQUE else OBLIQUE_SCATTER


def refined(comb: RowComb, bands: Bands) -> RowComb:
    """The comb fitted with the freedom that its view has, which may turn out another than it seemed."""
    if convergence_of(comb) >= OBLIQUE:
        for stiffness in OBLIQUE_VIEW:
            comb = refine(comb, bands, stiffness)
    return comb if convergence_of(comb) >= OBLIQUE else refine(comb, bands, STEEP_VIEW)


def curves_px(rows: CombRows, cover: Cover) -> Floats:
    """Curves through the bands' middles, carried on straight to the picture's edges."""
    place = rows.place
    upper = 1.5 * place[:, :1] - place[:, 1:2] / 2
    lower = 1.5 * place[:, -1:] - place[:, -2:-1] / 2
    x = np.concatenate([upper, place, lower], axis=1) * cover.width_px + (cover.width_px - 1) / 2
    return np.stack([x, np.broadcast_to(curve_rows_px(cover.height_px), x.shape)], axis=-1)


def curve_rows_px(height_px: int) -> Floats:
    """The image rows that curves have a point at: the edges and the middles of the bands."""
    level = np.concatenate([[-1 / 2], LEVEL, [1 / 2]])
    return np.asarray((level * height_px + (height_px - 1) / 2).clip(0, height_px - 1))


def _ends_px(rows: CombRows, comb: RowComb, cover: Cover) -> Floats:
    """Upper and lower end of the straight line nearest to each row's curve, shape (rows, 2).

    The near ground, which is drawn larger, counts more.
    """
    weight = np.where(comb.usable, comb.spacing, 0.0)
    basis = np.stack([1 / 2 - LEVEL, 1 / 2 + LEVEL], axis=-1)
    fitted = np.linalg.lstsq(basis * weight[:, None], (rows.place * weight).T, rcond=None)[0].T
    return np.asarray(fitted * cover.width_px + (cover.width_px - 1) / 2)
