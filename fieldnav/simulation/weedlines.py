"""Weeds in lines that are not rows: between the rows, in wheel tracks, along old tracks askew to the rows."""

from math import pi, radians

import numpy as np

from fieldnav.messages import Floats
from fieldnav.settings.field import FieldSettings
from fieldnav.simulation.rowlines import RowLines
from fieldnav.simulation.streams import Stream, random_stream

LENGTH_M = (3.0, 10.0)
STEP_M = 0.15  # between two weeds of a line, on average
SCATTER_M = 0.03  # rms, across the line
ASKEW_SHARE = 0.5  # of the lines
ASKEW_RAD = (radians(5), radians(40))
GAUGE_M = 1.8  # between the two wheels of the tractor that left a track
WEEDS_A_LINE = (LENGTH_M[0] + LENGTH_M[1]) / 2 / STEP_M
WEEDS_AN_ITEM = WEEDS_A_LINE * (1 + ASKEW_SHARE)  # an old track is two lines


def weed_lines(
    field: FieldSettings, rows: RowLines, across_m: tuple[float, float], species: int
) -> tuple[Floats, Floats]:
    """Weeds in lines: (s, n), shape (count, 2), within the strip `across_m`, and species, shape (count,)."""
    random = random_stream(field.seed, Stream.WEED_LINES)
    area_m2 = field.length_m * (across_m[1] - across_m[0])
    items = random.poisson(field.weeds.per_m2 * field.weeds.lines * area_m2 / WEEDS_AN_ITEM)
    places, kinds = [np.zeros((0, 2))], [np.zeros(0)]
    for _ in range(items):
        askew = random.random() < ASKEW_SHARE
        line = _old_track(random, field, across_m) if askew else _along_rows(random, field, rows)
        inside = (line[:, 0] >= 0) & (line[:, 0] <= field.length_m)
        inside &= (line[:, 1] >= across_m[0]) & (line[:, 1] <= across_m[1])
        places.append(line[inside])
        kinds.append(np.full(int(inside.sum()), random.integers(0, species)))
    return np.vstack(places), np.concatenate(kinds)


def _stretch(random: np.random.Generator) -> Floats:
    """Where along a line its weeds stand, from the line's middle, shape (n,)."""
    length_m = random.uniform(*LENGTH_M)
    return random.uniform(-length_m / 2, length_m / 2, random.poisson(length_m / STEP_M))


def _along_rows(random: np.random.Generator, field: FieldSettings, rows: RowLines) -> Floats:
    """A line between two rows or in a wheel track of a lane."""
    s = random.uniform(0, field.length_m) + _stretch(random)
    lanes, per_lane = rows.row_n_m.shape[:2]
    lane = int(random.integers(lanes))
    gap = int(random.integers(max(per_lane - 1, 1)))
    side = int(random.choice([-1, 1]))
    if random.random() < 1 / 2 and per_lane > 1:
        n = (rows.row_n(lane, gap, s) + rows.row_n(lane, gap + 1, s)) / 2
    else:
        n = rows.lane_n(lane, s) + side * field.lane_pitch_m / 2
    return np.stack([s, n + SCATTER_M * random.standard_normal(s.size)], axis=-1)


def _old_track(random: np.random.Generator, field: FieldSettings, across_m: tuple[float, float]) -> Floats:
    """Two lines of the wheels of a tractor that once drove over the field at an angle."""
    middle = np.array([random.uniform(0, field.length_m), random.uniform(*across_m)])
    angle = random.choice([-1, 1]) * random.uniform(*ASKEW_RAD) + pi * random.integers(2)
    ahead, left = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    wheels = []
    for side in (-1, 1):
        along = _stretch(random)
        aside = side * GAUGE_M / 2 + SCATTER_M * random.standard_normal(along.size)
        wheels.append(middle + along[:, None] * ahead + aside[:, None] * left)
    return np.vstack(wheels)
