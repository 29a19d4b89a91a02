"""How well the rows found in one Lincoln picture are the annotated ones, all rows being curves.

A curve is an array of shape (points, 2), x and y in pixels. Each found row is compared with each annotated
one over the height of the annotation; the nearest pairs are matched first.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.evaluation.found_rows import UNMATCHED, Indices
from fieldnav.messages import Floats

SIZE_PX = 512
"""Width and height of every picture of the set."""

LOWEST_QUARTER_PX = 384
"""The image row where the lowest quarter begins: an annotated row that reaches it must be found."""

MAX_DISTANCE_PX = 0.05 * SIZE_PX
"""Mean distance up to which a found row is an annotated one."""

LONE_ROW_GAP_PX = 100.0
"""Taken for the gap between rows where only one is annotated."""

FIRST_DEGREE = 1


@dataclass(frozen=True, slots=True)
class LincolnTally:
    """What was found of the annotated rows.

    main_rows: annotated rows that reach the lowest quarter; hits: those of them that were found; matched:
    found rows that are any annotated one; false_alarms: found rows that are none, although they cross the
    lowest quarter among the annotated ones. distance_px and turned_deg: shape (hits,), of each hit the mean
    distance and the angle between both rows, not negative.
    """

    main_rows: int
    matched: int
    false_alarms: int
    distance_px: Floats
    turned_deg: Floats

    @property
    def hits(self) -> int:
        return len(self.distance_px)

    @property
    def recall(self) -> float:
        return self.hits / self.main_rows if self.main_rows else float("nan")

    @property
    def precision(self) -> float:
        found = self.matched + self.false_alarms
        return self.matched / found if found else float("nan")

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall; 0 where no row was found, NaN where none is annotated."""
        if not self.main_rows or not self.hits:
            return 0.0 if self.main_rows else float("nan")
        return 2 * self.recall * self.precision / (self.recall + self.precision)


def total(tallies: Iterable[LincolnTally]) -> LincolnTally:
    """The tally over several pictures."""
    parts = list(tallies)
    return LincolnTally(
        sum(part.main_rows for part in parts),
        sum(part.matched for part in parts),
        sum(part.false_alarms for part in parts),
        np.concatenate([np.empty(0), *(part.distance_px for part in parts)]),
        np.concatenate([np.empty(0), *(part.turned_deg for part in parts)]),
    )


@dataclass(frozen=True, slots=True)
class LincolnJudgement:
    """The found rows against the annotated ones.

    true: shape (found,), which annotated row each is, UNMATCHED for none; counts: shape (found,), false for
    a row that lies beside everything that was annotated; distance_px: shape (found, true).
    """

    true: Indices
    counts: NDArray[np.bool_]
    distance_px: Floats


def judge(found: Sequence[Floats] | Floats, true: Sequence[Floats]) -> LincolnJudgement:
    """Match the found curves to the annotated ones."""
    distance_px = _mean_distance_px(found, true)
    matched = match_nearest_first(distance_px, MAX_DISTANCE_PX)
    return LincolnJudgement(matched, (matched != UNMATCHED) | _among(found, true), distance_px)


def score(found: Sequence[Floats] | Floats, true: Sequence[Floats]) -> LincolnTally:
    """The tally of one picture."""
    judged = judge(found, true)
    is_main = np.array([_image_rows(curve)[-1] >= LOWEST_QUARTER_PX for curve in true], dtype=bool)
    pairs = [(at, row) for at, row in enumerate(judged.true) if row != UNMATCHED and is_main[row]]
    turned = [_angle_between_deg(found[at], true[row]) for at, row in pairs]
    matched = int((judged.true != UNMATCHED).sum())
    return LincolnTally(
        int(is_main.sum()),
        matched,
        int(judged.counts.sum()) - matched,
        np.array([judged.distance_px[pair] for pair in pairs], dtype=np.float64),
        np.array(turned, dtype=np.float64),
    )


def match_nearest_first(distance: Floats, limit: float) -> Indices:
    """Which true row each found row is, one to one: the nearest pair of all, then the nearest of the rest.

    distance: shape (found, true); a pair matches up to `limit`. Shape (found,), UNMATCHED for none.
    """
    matched = np.full(len(distance), UNMATCHED, dtype=np.int64)
    rest = np.where(distance <= limit, distance, np.inf).T
    while np.isfinite(rest).any():
        true, found = np.unravel_index(rest.argmin(), rest.shape)
        matched[found] = true
        rest[true], rest[:, found] = np.inf, np.inf
    return matched


def columns(curve: Floats, image_rows: Floats) -> Floats:
    """Where a curve crosses the image rows, pixels; beyond its ends on a straight line fitted to it."""
    x, y = curve[np.argsort(curve[:, 1], kind="stable")].T
    inside: Floats = np.interp(image_rows, y, x)
    beyond = (image_rows < y[0]) | (image_rows > y[-1])
    if not beyond.any():
        return inside
    return np.where(beyond, np.polyval(np.polyfit(y, x, FIRST_DEGREE), image_rows), inside)


def _image_rows(curve: Floats) -> Floats:
    """Every image row that an annotated curve crosses, from the uppermost down."""
    return np.arange(curve[:, 1].min(), curve[:, 1].max() + 1)


def _mean_distance_px(found: Sequence[Floats] | Floats, true: Sequence[Floats]) -> Floats:
    distance_px = np.empty((len(found), len(true)))
    for row, annotated in enumerate(true):
        image_rows = _image_rows(annotated)
        there = columns(annotated, image_rows)
        for at, curve in enumerate(found):
            distance_px[at, row] = np.abs(columns(curve, image_rows) - there).mean()
    return distance_px


def _among(found: Sequence[Floats] | Floats, true: Sequence[Floats]) -> NDArray[np.bool_]:
    """Whether each found row enters the lowest quarter among the annotated rows, half a gap beyond included.

    Where no row is annotated, every found row counts.
    """
    if not len(true):
        return np.ones(len(found), dtype=bool)
    ours, theirs = _at_lowest_quarter(found), np.sort(_at_lowest_quarter(true))
    gap = float(np.median(np.diff(theirs))) if len(theirs) > 1 else LONE_ROW_GAP_PX
    left, right = theirs[0] - gap / 2, theirs[-1] + gap / 2
    return np.asarray((ours >= left) & (ours <= right), dtype=bool)


def _at_lowest_quarter(curves: Sequence[Floats] | Floats) -> Floats:
    """Where each curve enters the lowest quarter, shape (curves,)."""
    edge = np.array([float(LOWEST_QUARTER_PX)])
    return np.array([columns(curve, edge)[0] for curve in curves], dtype=np.float64)


def _angle_between_deg(found: Floats, true: Floats) -> float:
    """Between the straight lines fitted to both over the height of the annotation."""
    image_rows = _image_rows(true)
    ours, theirs = (
        np.arctan(np.polyfit(image_rows, columns(curve, image_rows), FIRST_DEGREE)[0])
        for curve in (found, true)
    )
    return float(np.degrees(abs(ours - theirs)))
