"""Crop rows from the field-structure signal: the moving variance of the windows' lines (paper III-A.2)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import find_peaks

from fieldnav.messages import Centres, Floats, RowLine
from fieldnav.perception.windows import window_lines
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import Finding

Indices = NDArray[np.int64]

SIMILAR_DEVIATION_DEG = (
    1.0  # neighbours of a trough within this standard deviation of it have a part in its line
)
CENTRES_OF_HALF_CONFIDENCE = 2.0
VARIANCE_OF_HALF_CONFIDENCE = 2.0  # times the prominence that is asked of a peak


@dataclass(frozen=True, slots=True)
class FieldStructure:
    """The signal that tells rows from the space between them; arrays of shape (n,), a place for each window.

    intersection_px: where the window's line meets the bottom edge; angle_deg: its angle from the vertical,
    positive clockwise; variance: the angles' moving variance in deg2; centres: plants in the window. NaN
    where a window has no line. peaks and troughs: indices of windows between rows and on rows.
    """

    intersection_px: Floats
    angle_deg: Floats
    variance: Floats
    centres: Floats
    peaks: Indices
    troughs: Indices


def field_structure(centres: Centres, finding: Finding, camera: Pinhole) -> FieldStructure:
    """The moving variance (paper eq. 1) of the window lines' angles, its peaks and troughs by prominence."""
    lines = window_lines(centres, finding, camera)
    angle = np.degrees(np.arctan(-lines.slope))
    variance = moving_variance(angle, finding.neighbours)
    peaks, troughs = _peaks_and_troughs(variance, finding.prominence_deg2)
    return FieldStructure(lines.bottom_px, angle, variance, lines.centres, peaks, troughs)


def find_rows(centres: Centres, finding: Finding, camera: Pinhole) -> tuple[RowLine, ...]:
    """The crop rows of an image from left to right; none where there are no plants.

    Troughs between two peaks are one row, unless their lines lie further apart than a window.
    """
    return rows_of(field_structure(centres, finding, camera), finding, camera)


def rows_of(structure: FieldStructure, finding: Finding, camera: Pinhole) -> tuple[RowLine, ...]:
    """The crop rows that a field structure shows, from left to right."""
    widest_px = finding.window * camera.width_px / 2
    candidates = [_line_at(structure, trough, widest_px, finding) for trough in structure.troughs]
    merged: list[Floats] = []
    for line in candidates:
        if merged and _same(merged[-1], line, widest_px, camera):
            merged[-1] = _average(merged[-1], line)
        else:
            merged.append(line)
    rows = [_row(line, camera) for line in merged]
    return tuple(sorted(rows, key=lambda row: row.x_top_px + row.x_bottom_px))


def moving_variance(angle: Floats, neighbours: int) -> Floats:
    """Variance of the angles within `neighbours` / 2 places on either side; NaN where there is no angle."""
    half = neighbours // 2
    centred = slice(half, half + len(angle))  # of a full convolution, also where half is the longer
    known = np.isfinite(angle)
    values = np.where(known, angle, 0.0)
    window = np.ones(2 * half + 1)
    count = np.convolve(known, window)[centred].clip(1)
    mean = np.convolve(values, window)[centred] / count
    padded = np.pad(np.where(known, angle, np.nan), half, constant_values=np.nan)
    around = np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1)
    squares = np.where(np.isfinite(around), (around - mean[:, None]) ** 2, 0.0)
    return np.where(known, squares.sum(axis=1) / count, np.nan)


def _peaks_and_troughs(variance: Floats, prominence: float) -> tuple[Indices, Indices]:
    """Peaks and troughs of the signal; a stretch without any line stands higher than the signal goes."""
    known = np.isfinite(variance)
    if not known.any():
        return np.empty(0, np.int64), np.empty(0, np.int64)
    wall = variance[known].max() + 2 * prominence
    signal = np.concatenate([[wall], np.where(known, variance, wall), [wall]])
    peaks, _ = find_peaks(signal, prominence=prominence)
    troughs, _ = find_peaks(-signal, prominence=prominence)
    return peaks - 1, troughs - 1


def _line_at(structure: FieldStructure, trough: np.int64, widest_px: float, finding: Finding) -> Floats:
    """A trough's line: (bottom_px, angle_deg, weight, centres, variance), averaged over its neighbourhood.

    The neighbourhood is the unbroken stretch around the trough where the deviation is similar and lines are
    near.
    """
    deviation = np.sqrt(structure.variance)
    near = np.abs(structure.intersection_px - structure.intersection_px[trough]) <= widest_px
    similar = near & (np.abs(deviation - deviation[trough]) <= SIMILAR_DEVIATION_DEG)
    breaks = np.flatnonzero(~similar)
    after = np.searchsorted(breaks, trough)
    first = breaks[after - 1] + 1 if after else 0
    last = breaks[after] if after < len(breaks) else len(similar)
    part = slice(first, last)
    weight = structure.centres[part] / (finding.prominence_deg2 + structure.variance[part])
    bottom = float(np.average(structure.intersection_px[part], weights=weight))
    angle = float(np.average(structure.angle_deg[part], weights=weight))
    variance = float(np.average(structure.variance[part], weights=weight))
    plants = float(structure.centres[part].max())
    agreement = 1 / (1 + variance / (VARIANCE_OF_HALF_CONFIDENCE * finding.prominence_deg2))
    confidence = agreement * plants / (plants + CENTRES_OF_HALF_CONFIDENCE)
    return np.array([bottom, angle, float(weight.sum()), confidence])


def _same(one: Floats, other: Floats, widest_px: float, camera: Pinhole) -> bool:
    """Whether two lines are less than half a window apart, on average over the ground's height."""
    height_px = camera.height_px - 1 - camera.top_px
    tops = [line[0] + np.tan(np.radians(line[1])) * height_px for line in (one, other)]
    return bool((abs(one[0] - other[0]) + abs(tops[0] - tops[1])) / 2 <= widest_px)


def _average(one: Floats, other: Floats) -> Floats:
    weight = one[2] + other[2]
    bottom, angle = (one[:2] * one[2] + other[:2] * other[2]) / weight
    return np.array([bottom, angle, weight, max(one[3], other[3])])


def _row(line: Floats, camera: Pinhole) -> RowLine:
    top = line[0] + np.tan(np.radians(line[1])) * (camera.height_px - 1)
    return RowLine(float(top), float(line[0]), float(line[3]))
