"""The lane under the robot among the rows found: a comb of rows as far apart as the profile says."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

OFF_COMB = 0.12  # of the row spacing: standard deviation of a row's distance from its place
OFF_HEADING = 0.15  # standard deviation of a found line's slope on the ground from the lane's
FURTHEST_OFF = 2.2  # standard deviations up to which a line is a row of the comb
LEAST_SHARE = 0.5  # of the lane's rows that must be seen
CENTRED_BONUS = 0.2  # a lane under the robot's middle scores by so much more than one at the bound


@dataclass(frozen=True, slots=True)
class LaneFit:
    """The rows of the lane under the robot.

    rows: one line for each row of the lane, left to right, confidence 0 for those filled in; offset_m and
    slope: the lane's middle on the ground, y = offset + slope x in the camera's ground coordinates;
    rows_seen: how many of the rows were really found; spacing_m: distance between neighbouring rows as found
    (NaN with fewer than two); misfit_m: rms distance of the rows found from their places in the comb;
    confidence: the probability that the lane is there.
    """

    rows: tuple[RowLine, ...]
    offset_m: float
    slope: float
    rows_seen: int
    spacing_m: float
    misfit_m: float
    confidence: float = 0.0


def comb_m(crop: CropProfile) -> Floats:
    """Places of the lane's rows about its middle, left to right, so y falls; shape (rows,)."""
    count = crop.rows.per_lane
    return np.asarray(((count - 1) / 2 - np.arange(count)) * crop.rows.spacing_m)


def widest_offset(crop: CropProfile, widest_offset_m: float | None = None) -> float:
    """How far to either side the lane's middle is looked for: half a row spacing unless told."""
    return crop.rows.spacing_m / 2 if widest_offset_m is None else widest_offset_m


def lane_rows(
    lines: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole, widest_offset_m: float | None = None
) -> LaneFit | None:
    """The lane under the robot among the lines found; None when fewer than half its rows are among them.

    The lane's middle is looked for within `widest_offset_m` (half a row spacing unless told) of the robot's,
    at the lower edge of the view, so that a neighbouring lane is never taken.
    """
    plane = canopy_plane(camera, crop)
    seen = [line for line in lines if line.confidence > 0]
    if not seen:
        return None
    found = np.array([(*plane.row_on_ground(line), line.confidence) for line in seen])
    near_m, far_m = plane.view_m
    middle_m = (near_m + far_m) / 2
    bound = widest_offset(crop, widest_offset_m)
    # Rows of lanes beside this one have no part in it, nor has what lies nowhere on the ground.
    reach = bound + (crop.rows.per_lane + 1) / 2 * crop.rows.spacing_m
    within = np.abs(found[:, 0] + found[:, 1] * near_m) <= reach
    found, seen = found[within], [line for line, near in zip(seen, within, strict=True) if near]
    if not len(found):
        return None
    offset, slope = _best_comb(found, comb_m(crop), middle_m, near_m, bound, crop.rows.spacing_m)
    return _fit(found, seen, (offset, slope), crop, plane) if np.isfinite(offset) else None


def _best_comb(
    found: Floats, comb: Floats, middle_m: float, near_m: float, bound: float, spacing: float
) -> tuple[float, float]:
    """Offset and slope of the comb that the lines, (offset, slope, confidence) each, agree with best."""
    place = found[:, 0] + found[:, 1] * middle_m
    slopes = np.append(found[:, 1], np.average(found[:, 1], weights=found[:, 2]))
    offsets = (place[:, None] - comb[None, :]).ravel()
    off_place = offsets[:, None, None] + comb[None, :, None] - place[None, None, :]
    near_place = np.exp(-0.5 * (off_place / (OFF_COMB * spacing)) ** 2)
    alike = np.exp(-0.5 * ((slopes[:, None] - found[None, :, 1]) / OFF_HEADING) ** 2)
    votes = near_place[:, None] * (alike * found[:, 2])[None, :, None, :]
    score = votes.max(axis=-1).sum(axis=-1)
    at_near = offsets[:, None] + slopes[None, :] * (near_m - middle_m)
    score = np.where(np.abs(at_near) <= bound, score * (1 - CENTRED_BONUS * (at_near / bound) ** 2), -1.0)
    best = np.unravel_index(int(np.argmax(score)), score.shape)
    if score[best] <= 0:
        return float("nan"), float("nan")
    return float(offsets[best[0]] - slopes[best[1]] * middle_m), float(slopes[best[1]])


def _fit(
    found: Floats, lines: list[RowLine], comb_line: tuple[float, float], crop: CropProfile, plane: Pinhole
) -> LaneFit | None:
    """The lane from the lines that belong to the best comb; None when they are too few."""
    comb, spacing = comb_m(crop), crop.rows.spacing_m
    middle_m = sum(plane.view_m) / 2
    rows = _assign(found, comb, comb_line, middle_m, spacing)
    seen = np.flatnonzero(rows >= 0)
    if len(seen) < max(1, LEAST_SHARE * len(comb)):
        return None
    chosen = found[rows[seen]]
    place = chosen[:, 0] + chosen[:, 1] * middle_m
    middle = float(np.average(place - comb[seen], weights=chosen[:, 2]))
    slope = float(np.average(chosen[:, 1], weights=chosen[:, 2]))
    offset = middle - slope * middle_m
    misfit = float(np.sqrt(np.mean((place - comb[seen] - middle) ** 2)))
    filled = [
        lines[rows[row]] if rows[row] >= 0 else plane.row_in_image(offset + comb[row], slope, 0.0)
        for row in range(len(comb))
    ]
    spacing_found = -float(np.polyfit(seen, place, 1)[0]) if len(seen) > 1 else float("nan")
    return LaneFit(tuple(filled), offset, slope, len(seen), spacing_found, misfit)


def _assign(
    found: Floats, comb: Floats, comb_line: tuple[float, float], middle_m: float, spacing: float
) -> NDArray[np.int64]:
    """For each row of the comb the index of the line that is it, -1 where there is none; shape (rows,)."""
    offset, slope = comb_line
    place = found[:, 0] + found[:, 1] * middle_m
    off_place = np.abs(place[None, :] - (offset + slope * middle_m + comb)[:, None]) / (OFF_COMB * spacing)
    off_heading = np.abs(found[:, 1] - slope)[None, :] / OFF_HEADING
    misfit = np.hypot(off_place, off_heading)
    rating = np.where(np.maximum(off_place, off_heading) <= FURTHEST_OFF, np.exp(-0.5 * misfit**2), 0.0)
    rating = rating * found[:, 2]
    best = rating.argmax(axis=1)
    return np.where(rating.max(axis=1) > 0, best, -1)
