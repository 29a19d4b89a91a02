"""CRDA, the score of the Crop Row Benchmark Dataset, and which of its true rows a found one is.

Vidovic, Cupec, Hocenski, Crop row detection by global energy minimization, Pattern Recognition 55, 2016.
"""

import numpy as np

from fieldnav.evaluation.crbd_truth import CENTRE_PX, HEIGHT_PX, TrueLattice
from fieldnav.evaluation.found_rows import Indices, match
from fieldnav.messages import Floats

GROUP = 3
"""Neighbouring rows that are scored, m in the paper."""

TOLERANCE = 0.1
"""Of the spacing: distance at which a place scores nothing."""

LOWER_HALF_PX = HEIGHT_PX // 2
"""The first image row of the lower half."""

RIGHT_WITHIN = 0.25
"""Of the spacing: mean distance over the lower half below which a found row is a true one."""


def positions(paths_px: Floats) -> Floats:
    """The column of each curve at every image row, NaN beyond its ends; shape (rows, height).

    paths_px: shape (rows, points, 2), x and y, from top to bottom.
    """
    image_rows = np.arange(HEIGHT_PX, dtype=np.float64)
    columns = [np.interp(image_rows, path[:, 1], path[:, 0], np.nan, np.nan) for path in paths_px]
    return np.array(columns, dtype=np.float64).reshape(-1, HEIGHT_PX)


def crda(found_px: Floats, truth: TrueLattice, first_row: int = 0) -> float:
    """The score, 0 to 1, from image row `first_row` down; found_px: shape (rows, height), any order.

    Image rows without ground truth do not count; where a true row lies outside the picture it scores 0.
    """
    group = _central(found_px)
    known = np.isfinite(truth.spacing_px)
    known[:first_row] = False
    if group is None or not known.any():
        return 0.0
    visible = truth.visible()
    if not len(visible):
        return 0.0
    firsts = np.arange(visible[0] - GROUP + 1, visible[-1] + 1)
    true = truth.rows(firsts[:, None] + np.arange(GROUP))[..., known]
    off = (true - group[None][..., known]) / (TOLERANCE * truth.spacing_px[known])
    each = np.where(np.isfinite(off), np.maximum(1 - off**2, 0), 0.0)
    return float(each.mean(axis=(1, 2)).max())


def _central(found_px: Floats) -> Floats | None:
    """The three neighbours whose middle one is nearest the centre at the lower edge; None of fewer rows."""
    reaching = found_px[np.isfinite(found_px[:, -1])]
    if len(reaching) < GROUP:
        return None
    ordered = reaching[np.argsort(reaching[:, -1])]
    middle = 1 + int(np.argmin(np.abs(ordered[1:-1, -1] - CENTRE_PX)))
    return np.asarray(ordered[middle - 1 : middle + 2])


def true_rows(found_px: Floats, truth: TrueLattice) -> Indices:
    """Which true row each found one is, by the lower half, one to one; shape (rows,), UNMATCHED for none.

    A place outside the picture is not compared; a row that lies outside all along is none of them.
    """
    true = truth.rows(truth.visible())
    off = (np.abs(found_px[:, None] - true[None]) / truth.spacing_px)[..., LOWER_HALF_PX:]
    compared = np.isfinite(off)
    count = compared.sum(axis=-1)
    mean = np.where(compared, off, 0.0).sum(axis=-1) / np.maximum(count, 1)
    return match(np.where(count > 0, mean, np.inf), RIGHT_WITHIN)
