"""Rows just found, fitted to the plants along them, and judged by them."""

import numpy as np

from fieldnav.messages import Floats, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import STRAY, Followed, follow, scatter_m, widest_m
from fieldnav.perception.found import LEAST_CONFIDENCE
from fieldnav.perception.ground_plants import GroundPlants
from fieldnav.perception.ground_rows import GroundRows, fit, members
from fieldnav.perception.lane import LEAST_SHARE, LaneFit, comb_m, widest_offset
from fieldnav.perception.lane_search import support
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

ROUNDS = 2  # of fitting a fresh lane
CLEARLY_BETTER = 1.15  # a comb elsewhere is taken over the lines' when it scores so many times more
# Natural logarithm of how much likelier rows are than plants strewn about: weeds reach 2, four plants 5.
EVIDENCE = 3.0
UNSURE = 0.05  # confidence that a finder is taken to have in rows that it does not show
SPREAD = 1.3  # standard deviation about a row just found, against that about the true one
LINE_OFFSET_PRIOR_M = 0.05  # standard deviation of a found line's distance from its row


def settle(
    lane: LaneFit | None,
    plants: GroundPlants,
    crop: CropProfile,
    camera: Pinhole,
    widest_offset_m: float | None = None,
) -> LaneFit | None:
    """The lane that lines showed, or a better one near it, fitted to the plants along its rows.

    None when fewer than half its rows have plants, or when plants strewn about would look the same.
    """
    if not len(plants):
        return None
    plane = canopy_plane(camera, crop)
    near_m, far_m = plane.view_m
    about_m = (near_m + far_m) / 2
    place = comb_m(crop)
    scores = support(plants, place, about_m, near_m, widest_offset(crop, widest_offset_m))
    offset, slope, best = scores.best()
    if lane is not None:
        middle = lane.offset_m + lane.slope * about_m
        if scores.near(middle, lane.slope) * CLEARLY_BETTER >= best:
            offset, slope = middle, lane.slope
        else:
            lane = None
    followed = follow(GroundRows(offset, slope, place, np.zeros(len(place)), about_m), plants, crop)
    if lane is None:  # what the search alone found may lie a plant's width off
        followed = follow(followed.comb, plants, crop)
    sure = _sure_of(lane, len(place))
    enough = (followed.seen | (sure >= LEAST_CONFIDENCE)).sum() >= max(1, LEAST_SHARE * len(place))
    total = evidence(followed.comb, plants, crop, plane) + _log_odds(sure)
    if not enough or total < EVIDENCE:
        return None
    return _lane(followed, sure, 1 / (1 + float(np.exp(EVIDENCE - total))), crop, plane)


def _sure_of(lane: LaneFit | None, rows: int) -> Floats:
    """How sure the finder is of each of the lane's rows, shape (rows,); 0 where it has none."""
    return np.array([row.confidence for row in lane.rows]) if lane else np.zeros(rows)


def _log_odds(sure: Floats) -> float:
    """What the rows that the finder shows are worth as evidence; less than nothing when it shows none."""
    shown = sure[sure > 0]
    odds = float(shown.mean()) if len(shown) else 0.0
    odds = min(max(odds, UNSURE), 1 - UNSURE)
    return float(np.log(odds / (1 - odds)))


def evidence(comb: GroundRows, plants: GroundPlants, crop: CropProfile, plane: Pinhole) -> float:
    """How much likelier the plants are with these rows than strewn over the view, as a natural logarithm.

    Each plant adds its likelihood ratio, by its weight: normally distributed about the nearest row, or, with
    the share STRAY, anywhere.
    """
    spread_m = SPREAD * scatter_m(crop)
    view_m = plane.width_px / float(plane.pixels_per_metre(plane.ground_middle_px))
    off = np.abs(comb.residual_m(plants)).min(axis=0)
    on_row = np.exp(-0.5 * (off / spread_m) ** 2) / (spread_m * np.sqrt(2 * np.pi) * len(comb.place_m))
    ratio = (1 - STRAY) * on_row * view_m + STRAY
    return float((plants.weight * np.log(ratio)).sum())


def settle_lines(
    lines: tuple[RowLine, ...], plants: GroundPlants, crop: CropProfile, camera: Pinhole
) -> tuple[RowLine, ...]:
    """Every line found, fitted to the plants along it and turned to their common heading, left to right."""
    if not lines or not len(plants):
        return lines
    plane = canopy_plane(camera, crop)
    about_m = sum(plane.view_m) / 2
    offset, slope = np.array([plane.row_on_ground(line) for line in lines]).T
    confidence = np.array([line.confidence for line in lines])
    common = float(np.average(slope, weights=confidence))
    middle = offset + slope * about_m
    comb = GroundRows(0.0, common, middle, np.zeros(len(lines)), about_m)
    for _ in range(ROUNDS):
        row = members(comb, plants, widest_m(crop))
        comb = fit(comb, plants, row, scatter_m(crop), LINE_OFFSET_PRIOR_M)
    return tuple(sorted(comb.in_image(confidence, plane), key=lambda line: line.x_top_px + line.x_bottom_px))


def _lane(followed: Followed, sure: Floats, confidence: float, crop: CropProfile, plane: Pinhole) -> LaneFit:
    comb, place = followed.comb, comb_m(crop)
    seen = followed.seen | (sure >= LEAST_CONFIDENCE)
    which = np.flatnonzero(seen)
    spacing = -float(np.polyfit(which, comb.place_m[which], 1)[0]) if len(which) > 1 else float("nan")
    off = (comb.place_m - place)[which]
    misfit = float(np.sqrt(np.mean((off - off.mean()) ** 2)))
    rows = comb.in_image(np.maximum(followed.confidence, sure * seen), plane)
    offset = comb.offset_m + float(np.mean(comb.place_m - place)) - comb.slope * comb.about_m
    return LaneFit(rows, offset, comb.slope, len(which), spacing, misfit, confidence)
