"""How well the rows found in one photograph are the true ones: hits, misses, false alarms, errors."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.evaluation.found_rows import UNMATCHED, match
from fieldnav.messages import Floats, RowLine

JUDGED_FROM = 0.25  # of the image's height: rows are compared over the lower three quarters
FURTHEST = 0.05  # of the image's width: mean distance below which a row is a true one


@dataclass(frozen=True, slots=True)
class Tally:
    """What was found of the rows that must be found.

    distance: shape (hits,), mean distance of each hit from its row, as a share of the width; turned_deg:
    shape (hits,), the angle between both, not negative.
    """

    misses: int
    false_alarms: int
    distance: Floats
    turned_deg: Floats

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall; NaN where there is neither a true row nor a found one."""
        hits = len(self.distance)
        counted = 2 * hits + self.misses + self.false_alarms
        return 2 * hits / counted if counted else float("nan")


def total(tallies: Iterable[Tally]) -> Tally:
    """The tally over several photographs."""
    parts = list(tallies)
    return Tally(
        sum(part.misses for part in parts),
        sum(part.false_alarms for part in parts),
        np.concatenate([np.empty(0), *(part.distance for part in parts)]),
        np.concatenate([np.empty(0), *(part.turned_deg for part in parts)]),
    )


@dataclass(frozen=True, slots=True)
class Judgement:
    """The rows found against the true ones.

    true: shape (found,), which true row each is, UNMATCHED for none; counts: shape (found,), false where that
    row need not be found; distance: shape (found, true), a share of the width.
    """

    true: NDArray[np.int64]
    counts: NDArray[np.bool_]
    distance: Floats


def judge(
    found: Sequence[RowLine], true: Sequence[RowLine], must_be_found: Sequence[bool], size: tuple[int, int]
) -> Judgement:
    """Match the found rows to the true ones; `size` is the image's width and height in pixels."""
    distance = mean_distance(found, true, size)
    matched = match(distance, FURTHEST)
    optional = ~np.array(must_be_found, dtype=bool)
    counts = np.array([index == UNMATCHED or not optional[index] for index in matched], dtype=bool)
    return Judgement(matched, counts, distance)


def score(
    found: Sequence[RowLine], true: Sequence[RowLine], must_be_found: Sequence[bool], size: tuple[int, int]
) -> Tally:
    """The tally of one photograph: a row that need not be found is neither miss nor false alarm."""
    judged = judge(found, true, must_be_found, size)
    hits = np.flatnonzero(judged.counts & (judged.true != UNMATCHED))
    rows = judged.true[hits]
    turned = np.abs(angles_deg(found, size[1])[hits] - angles_deg(true, size[1])[rows])
    false_alarms = int(np.sum(judged.true == UNMATCHED))
    return Tally(sum(must_be_found) - len(hits), false_alarms, judged.distance[hits, rows], turned)


def mean_distance(found: Sequence[RowLine], true: Sequence[RowLine], size: tuple[int, int]) -> Floats:
    """Mean horizontal distance over the lower three quarters, a share of the width; shape (found, true)."""
    width, height = size
    down = np.arange(round(JUDGED_FROM * height), height) / max(height - 1, 1)
    ours, theirs = _ends(found), _ends(true)
    top, bottom = (ours[:, None, end, None] - theirs[None, :, end, None] for end in (0, 1))
    return np.asarray(np.abs(top + (bottom - top) * down).mean(axis=-1) / width)


def angles_deg(rows: Sequence[RowLine], height: int) -> Floats:
    """Angles from the image's vertical, positive clockwise; shape (rows,)."""
    ends = _ends(rows)
    return np.degrees(np.arctan2(ends[:, 0] - ends[:, 1], height - 1))


def _ends(rows: Sequence[RowLine]) -> Floats:
    """Where rows meet the upper and the lower edge, in pixels; shape (rows, 2)."""
    return np.array([(row.x_top_px, row.x_bottom_px) for row in rows], dtype=np.float64).reshape(-1, 2)
