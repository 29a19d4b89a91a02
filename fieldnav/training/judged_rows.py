"""What speaks for the rows that perception might see in drawn pictures, and whether they are there."""

from collections.abc import Iterable
from functools import partial

import cv2
import numpy as np
from scipy.optimize import linear_sum_assignment

from fieldnav.evaluation.judged_candidates import JudgedPicture, judged_picture, worth_of
from fieldnav.perception.comb.row_contrast import HEIGHTS, PlacedRows
from fieldnav.perception.comb.row_judge import CandidateMeasures
from fieldnav.training.canvas import HEIGHT_PX, WIDTH_PX
from fieldnav.training.drawn_picture import DrawnPicture, draw
from fieldnav.training.ground_camera import Floats
from fieldnav.training.truth import FULL_HEAT, RowCourse

ENLARGED = 2
"""Drawn pictures are small: perception looks at them so many times larger."""
MAX_OFF, MAX_OFF_SPACING = 0.05, 0.35
"""Mean distance of a row from the true one, in widths and in spacings."""
SEEN_HEAT, SEEN_SHARE = 0.4, 0.4
"""A true row must be found that the truth shows on this share of the heights within the picture,"""
LOWEST, LEAST_INSIDE = 0.75, 0.25
"""some of them at least so low; one that is inside on fewer heights need not be."""
FAR_OFF = 1e3
FEWEST_POINTS = 2


def judged_pictures(seeds: Iterable[int]) -> list[JudgedPicture]:
    """The candidates of each seed's picture."""
    cv2.setNumThreads(1)
    return [judged(draw(seed)) for seed in seeds]


def judged(drawn: DrawnPicture) -> JudgedPicture:
    """All that perception might see in a drawn picture, with what is true of it."""
    size = (WIDTH_PX * ENLARGED, HEIGHT_PX * ENLARGED)
    image = np.asarray(cv2.resize(drawn.image, size, interpolation=cv2.INTER_CUBIC), np.uint8)
    true = np.array([_place(row) for row in drawn.rows]).reshape(-1, len(HEIGHTS))
    seen = np.array([_is_seen(place, drawn) for place in true], bool)
    return judged_picture(image, partial(_truth, true, seen))


def _truth(true: Floats, seen: Floats, measured: CandidateMeasures) -> tuple[float, Floats]:
    right, turned_deg = _compared(measured.rows, true, seen)
    return worth_of(right, int(seen.sum()), turned_deg[right == 1]), right


def _compared(rows: PlacedRows, true: Floats, seen: Floats) -> tuple[Floats, Floats]:
    """Whether each row is a true one, and by how many degrees it is turned from that; shape (rows,) each."""
    right, turned = np.zeros(len(rows.place)), np.full(len(rows.place), np.nan)
    if not len(true) or not len(rows.place):
        return right, turned
    inside = (true >= 0) & (true < 1)
    off = np.abs(rows.place[:, None] - true[None]) * inside
    mean = off.sum(axis=-1) / np.maximum(inside.sum(axis=-1), 1)
    mean = np.where(inside.mean(axis=-1) >= LEAST_INSIDE, mean, FAR_OFF)
    limit = min(MAX_OFF, MAX_OFF_SPACING * float(rows.spacing.mean()))
    for own, other in zip(*linear_sum_assignment(np.minimum(mean, limit)), strict=True):
        if mean[own, other] < limit:
            right[own] = 1.0 if seen[other] else np.nan
            turned[own] = _angle_between_deg(rows.place[own], true[other], inside[other])
    return right, turned


def _angle_between_deg(one: Floats, other: Floats, inside: Floats) -> float:
    """Between the lines fitted to two rows, in the picture's own proportions."""
    down = HEIGHTS[inside] * HEIGHT_PX / WIDTH_PX
    first, second = (np.arctan(np.polyfit(down, place[inside], 1)[0]) for place in (one, other))
    return float(np.degrees(abs(first - second)))


def _place(row: RowCourse) -> Floats:
    """Where a row runs at HEIGHTS, in widths; far outside where it does not run."""
    order = np.argsort(row.y_px)
    x, y = row.x_px[order] / WIDTH_PX, row.y_px[order] / HEIGHT_PX
    if len(y) < FEWEST_POINTS:
        return np.full(len(HEIGHTS), -FAR_OFF)
    return np.interp(HEIGHTS, y, x, -FAR_OFF, -FAR_OFF)


def _is_seen(place: Floats, drawn: DrawnPicture) -> bool:
    """Whether the truth shows enough of a row for it to be missed."""
    inside = (place >= 0) & (place < 1)
    if inside.mean() < LEAST_INSIDE or HEIGHTS[inside].max() < LOWEST:
        return False
    high, wide = drawn.heat.shape
    down = (HEIGHTS[inside] * high).astype(int)
    right = (place[inside] * wide).astype(int)
    shown = (drawn.heat[down, right] > SEEN_HEAT * FULL_HEAT) & ~drawn.ignored[down, right]
    return float(shown.mean()) >= SEEN_SHARE
