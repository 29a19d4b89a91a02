"""Round figures along an axis, and curves thinned out to what an axis can show."""

from math import ceil, floor, log10

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats

ROUND = (1.0, 2.0, 5.0, 10.0)
"""Steps that people count in, times a power of ten."""
CLOCK_S = (1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400)
"""The same for time, s."""
SECONDS_A_MINUTE = 60
HEADROOM = 0.06
"""Of the values' range, above and below."""


def round_steps(low: float, high: float, most: int) -> list[float]:
    """Round figures from low to high, at most so many and one."""
    raw = (high - low) / most
    power = 10.0 ** floor(log10(raw))
    step = next(factor * power for factor in ROUND if factor * power >= raw * (1 - 1e-9))
    return [
        round(index * step, 10) for index in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)
    ]


def clock_steps(low_s: float, high_s: float, most: int) -> list[float]:
    """Round times from low to high."""
    step = next((step for step in CLOCK_S if step * most >= high_s - low_s), CLOCK_S[-1])
    return [float(index * step) for index in range(ceil(low_s / step), floor(high_s / step) + 1)]


def minutes(seconds: float) -> str:
    """A time on an axis, to the second."""
    return f"{int(seconds) // SECONDS_A_MINUTE}:{int(seconds) % SECONDS_A_MINUTE:02d}"


def range_of(values: list[Floats]) -> tuple[float, float]:
    """The values' range with some headroom; one around the value where there is only one."""
    finite = np.concatenate([each[np.isfinite(each)] for each in values])
    low, high = float(finite.min()), float(finite.max())
    room = HEADROOM * (high - low) or max(abs(high) * HEADROOM, HEADROOM)
    return low - room, high + room


def thinned(time_s: Floats, values: Floats, most: int) -> NDArray[np.intp]:
    """Indices that keep the shape: each of `most` stretches of time keeps its lowest and its highest value.

    Gaps stay gaps: of a stretch with values that are nan one of those is kept, too.
    """
    if len(values) <= 2 * most:
        return np.arange(len(values))
    span_s = float(time_s[-1] - time_s[0]) or 1.0
    stretch = np.minimum(((time_s - time_s[0]) / span_s * most).astype(np.intp), most - 1)
    kept = []
    for indices in np.split(np.arange(len(values)), np.flatnonzero(np.diff(stretch)) + 1):
        known = indices[np.isfinite(values[indices])]
        if len(known):
            kept += [known[np.argmin(values[known])], known[np.argmax(values[known])]]
        if len(known) < len(indices):
            kept.append(indices[~np.isfinite(values[indices])][0])
    return np.unique(kept)
