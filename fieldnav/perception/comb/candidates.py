"""What the rows of a picture might be: combs of vegetation and of the network, straight and bent."""

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from fieldnav.messages import Floats, Image
from fieldnav.perception.comb.bands import LEVEL, Bands, bands_of
from fieldnav.perception.comb.confidence import confidence_of
from fieldnav.perception.comb.evidence import evidence_of
from fieldnav.perception.comb.finder import (
    OBLIQUE_SCATTER,
    OBLIQUE_VIEW,
    STEEP_SCATTER,
    convergence_of,
    curve_rows_px,
    curves_px,
    refined,
    scatter_of,
)
from fieldnav.perception.comb.periodogram import SearchRange, candidates
from fieldnav.perception.comb.refinement import Stiffness, refine
from fieldnav.perception.comb.row_comb import RowComb
from fieldnav.perception.comb.rows import CombRows, rows_of
from fieldnav.perception.comb.straight_search import FittedComb, fitted, straight_combs
from fieldnav.perception.row_network import RowHeat
from fieldnav.perception.vegetation import Cover, vegetation_of
from fieldnav.settings.crop import Vegetation

STRAIGHT = 2  # straight combs of both witnesses that are kept
IN_VIEW = 0.4  # share of the height that a row must show
NEAR_PART = 0.35  # of the height that is left out where the near part is looked at by itself
NEAR_COMBS = 3
BENDABLE = 0.6  # convergence from which on bends and hills can be seen
GENTLY = Stiffness(4, 2, middle=0.006, spacing=0.6, start=0.2, end=0.12, rounds=5)
GENTLE_SCATTER = 0.4
ALMOST_NOTHING = 1e-3


class Source(Enum):
    """How a candidate was found."""

    STRAIGHT = "straight"
    BENT = "bent"
    VEGETATION = "vegetation"
    NEAR_VEGETATION = "near vegetation"


@dataclass(frozen=True, slots=True)
class Candidate:
    """Rows that a picture may show.

    paths_px: shape (rows, points, 2), x and y, from left to right, each from the upper edge to the lower;
    convergence and rows_across as in `row_comb.straight`; source: how they were found; sure: how sure
    vegetation by itself is of them, 0 where the network had a part in finding them.
    """

    paths_px: Floats
    convergence: float
    rows_across: float
    source: Source
    sure: float = 0.0


def candidates_in(
    image: Image, cover: Cover, heat: RowHeat, tried: SearchRange, vegetation: Vegetation
) -> list[Candidate]:
    """Every candidate of a picture that shows a row over enough of its height; none where nothing grows."""
    bands = bands_of(cover.strength)
    if bands.empty:
        return []
    evidence = evidence_of(bands, heat)
    found = _straight_and_bent(bands, evidence, cover)
    combs = [refined(comb, bands) for comb in candidates(bands, tried)[: tried.refined]]
    found += [_of_vegetation(comb, bands, cover, Source.VEGETATION) for comb in combs]
    if combs:
        best = fitted(max(combs, key=lambda comb: comb.response(bands)), evidence)
        found.append(_straight(best, bands, cover))
    return [each for each in [*found, *_near(image, tried, vegetation)] if len(each.paths_px)]


def _straight_and_bent(bands: Bands, evidence: Bands, cover: Cover) -> list[Candidate]:
    """What both witnesses show together; the best of it also as curves, which vegetation alone tells well."""
    straight = straight_combs(evidence)[:STRAIGHT]
    found = [_straight(each, bands, cover) for each in straight]
    if not straight or convergence_of(straight[0].comb) < BENDABLE:
        return found
    comb = straight[0].comb
    gently = refine(comb, evidence, GENTLY)
    found.append(_candidate(gently, rows_of(gently, bands, GENTLE_SCATTER, IN_VIEW), cover, Source.BENT))
    for stiffness in OBLIQUE_VIEW:
        comb = refine(comb, bands, stiffness)
    return [*found, _candidate(comb, rows_of(comb, bands, OBLIQUE_SCATTER, IN_VIEW), cover, Source.BENT)]


def _straight(found: FittedComb, bands: Bands, cover: Cover) -> Candidate:
    """Its rows where vegetation has them, which is sharper than the network's picture."""
    rows = rows_of(found.comb, bands, STEEP_SCATTER, IN_VIEW)
    return _candidate(found.comb, rows, cover, Source.STRAIGHT)


def _of_vegetation(comb: RowComb, bands: Bands, cover: Cover, source: Source) -> Candidate:
    rows = rows_of(comb, bands, scatter_of(comb), IN_VIEW)
    sure = float(confidence_of(rows, comb, bands).mean()) if len(rows) else 0.0
    return replace(_candidate(comb, rows, cover, source), sure=sure)


def _near(image: Image, tried: SearchRange, vegetation: Vegetation) -> list[Candidate]:
    """The near part by itself: a verge, the sky or another slope behind it has no part in it."""
    top_px = round(NEAR_PART * len(image))
    cover = vegetation_of(image[top_px:], vegetation)
    bands = bands_of(cover.strength)
    combs = candidates(bands, tried)[:NEAR_COMBS]
    found = [_of_vegetation(refined(comb, bands), bands, cover, Source.NEAR_VEGETATION) for comb in combs]
    return [_in_whole(each, top_px, len(image)) for each in found]


def _in_whole(near: Candidate, top_px: int, height_px: int) -> Candidate:
    """A candidate of the lower part as one of the whole picture, its rows carried on straight."""
    share = 1 - top_px / height_px
    at_middle = 1 + near.convergence * ((0.5 - top_px / height_px) / share - 0.5)
    scale = max(at_middle, ALMOST_NOTHING)
    paths_px = near.paths_px + np.array([0.0, float(top_px)])
    first, second = paths_px[:, 0], paths_px[:, 1]
    rise = top_px / np.maximum(second[:, 1] - first[:, 1], 1.0)
    top = np.stack([first[:, 0] - (second[:, 0] - first[:, 0]) * rise, np.zeros(len(paths_px))], axis=-1)
    whole = np.concatenate([top[:, None], paths_px], axis=1)
    y = curve_rows_px(height_px)
    x = np.array([np.interp(y, path[:, 1], path[:, 0]) for path in whole]).reshape(len(whole), len(y))
    return replace(
        near,
        paths_px=np.stack([x, np.broadcast_to(y, x.shape)], axis=-1),
        convergence=near.convergence / share / scale,
        rows_across=near.rows_across / scale,
    )


def _candidate(comb: RowComb, rows: CombRows, cover: Cover, source: Source) -> Candidate:
    across = 1 / float(np.interp(0.0, LEVEL, comb.spacing))
    return Candidate(curves_px(rows, cover), convergence_of(comb), across, source)
