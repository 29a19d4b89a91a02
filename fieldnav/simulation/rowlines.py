"""The lines that the drill drew: where each row of each lane runs, and where it starts and ends."""

from dataclasses import dataclass
from functools import cached_property
from math import sqrt

import numpy as np
from numpy.typing import ArrayLike
from scipy.ndimage import gaussian_filter1d

from fieldnav.messages import Floats
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.simulation.streams import Stream, random_stream

WANDER_STEP_M = 0.2  # the wander is far smoother than this
MARGIN_M = 5.0  # of line beyond both row ends, for a camera that looks there
SHARED_WANDER = 0.8  # share of the wander's variance that all rows of a pass of the drill have in common


@dataclass(frozen=True)
class RowLines:
    """Row lines in field coordinates (see centreline).

    lane_n_m: shape (lanes,), where each lane's centre line runs by plan;
    row_n_m: shape (lanes, rows, steps), where each row really runs, at `s_m`, shape (steps,);
    start_m, end_m: shape (lanes, rows), s at which each row starts and ends.
    """

    lane_n_m: Floats
    s_m: Floats
    row_n_m: Floats
    start_m: Floats
    end_m: Floats

    @cached_property
    def middle_n_m(self) -> Floats:
        """Where the middle of each lane's rows really runs, shape (lanes, steps)."""
        return np.asarray(self.row_n_m.mean(axis=1))

    def row_n(self, lane: int, row: int, s: ArrayLike) -> Floats:
        """Distance n of a row from the field's centre line, at distances `s`."""
        return np.asarray(np.interp(np.asarray(s, dtype=float), self.s_m, self.row_n_m[lane, row]))

    def lane_n(self, lane: int, s: ArrayLike) -> Floats:
        """The same for the middle of a lane's rows: the line that a perfect robot drives."""
        return np.asarray(np.interp(np.asarray(s, dtype=float), self.s_m, self.middle_n_m[lane]))

    def mirrored(self) -> "RowLines":
        """The same lines with left and right exchanged; rows keep their order from right to left."""
        return RowLines(
            -self.lane_n_m,
            self.s_m,
            -self.row_n_m[:, ::-1],
            self.start_m[:, ::-1].copy(),
            self.end_m[:, ::-1].copy(),
        )


def draw_rows(field: FieldSettings, crop: CropProfile, side_sign: int) -> RowLines:
    """Rows of every lane; the lanes follow each other to the left for side_sign 1, to the right for -1."""
    lane_n = side_sign * field.lane_pitch_m * np.arange(field.lanes, dtype=float) + _pass_errors(field)
    steps = round((field.length_m + 2 * MARGIN_M) / WANDER_STEP_M) + 1
    s = np.linspace(-MARGIN_M, field.length_m + MARGIN_M, steps)
    lanes, rows = field.lanes, crop.rows.per_lane
    offsets = np.stack([_row_offsets(field, crop, lane) for lane in range(lanes)])
    wander = np.stack([_wander(field, lane, rows, s) for lane in range(lanes)])
    ends = np.stack([_row_ends(field, lane, rows) for lane in range(lanes)])
    row_n = lane_n[:, None, None] + offsets[:, :, None] + wander
    return RowLines(lane_n, s, row_n, ends[:, :, 0], field.length_m + ends[:, :, 1])


def _pass_errors(field: FieldSettings) -> Floats:
    """How far each pass of the drill lies from its place, shape (lanes,); the first is where it is."""
    drawn = [random_stream(field.seed, Stream.PASS, lane).uniform(-1, 1) for lane in range(field.lanes)]
    return np.array([0.0, *drawn[1:]]) * field.rows.pass_error_m


def _row_offsets(field: FieldSettings, crop: CropProfile, lane: int) -> Floats:
    """Offset of each row from its lane's centre; uneven distances leave the lane's centre where it is."""
    rows, spacing = crop.rows.per_lane, crop.rows.spacing_m
    even = (np.arange(rows) - (rows - 1) / 2) * spacing
    random = random_stream(field.seed, Stream.ROW_SPACING, lane)
    error = random.uniform(-1, 1, rows) * field.rows.spacing_error * spacing / 2
    return np.asarray(even + error - error.mean())


def _wander(field: FieldSettings, lane: int, rows: int, s: Floats) -> Floats:
    """Smooth departure of each row from its line, shape (rows, steps), rms `wander_m`."""
    random = random_stream(field.seed, Stream.WANDER, lane)
    sigma = field.rows.wander_length_m / sqrt(2) / (s[1] - s[0])  # white noise so smoothed correlates over it
    white = random.standard_normal((s.size, rows + 1)).T
    smooth = gaussian_filter1d(white, sigma, axis=1, mode="wrap")
    unit = smooth * sqrt(2 * sqrt(np.pi) * sigma)
    shared, own = unit[0], unit[1:]
    return np.asarray(field.rows.wander_m * (sqrt(SHARED_WANDER) * shared + sqrt(1 - SHARED_WANDER) * own))


def _row_ends(field: FieldSettings, lane: int, rows: int) -> Floats:
    """How far each row's start and end lie from the field's, shape (rows, 2)."""
    random = random_stream(field.seed, Stream.ROW_ENDS, lane)
    return random.uniform(-field.rows.ragged_m, field.rows.ragged_m, (rows, 2))
