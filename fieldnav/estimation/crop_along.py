"""How much crop stands along a lane, as one camera's frames show it: a strip of short bins on the ground.

Along the lane everything lies at s, the distance driven plus how far ahead it is seen.
"""

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats

BIN_M = 0.05
KEPT_M = 8.0  # of the strip, about the robot: further behind nothing is decided on


class CropAlong:
    """The mean over all looks of what each bin holds: whole plants in the lane's rows."""

    def __init__(self, begin_m: float) -> None:
        """begin_m: the least s that will be seen."""
        self._first = round(begin_m / BIN_M)
        self._held = np.zeros(round(KEPT_M / BIN_M))
        self._looks = np.zeros(len(self._held))

    def add(self, s_m: Floats, weight: Floats, view_m: tuple[float, float]) -> None:
        """Take in a frame: where plants stand, their weights, shape (m,), and the stretch that was in view.

        Weights may be less than nothing where as much grows between the rows.
        """
        self._keep_up(view_m[1])
        view = slice(*(max(0, round(edge / BIN_M) - self._first) for edge in view_m))
        index = np.floor(s_m / BIN_M).astype(int) - self._first
        inside = (index >= view.start) & (index < view.stop)
        held = np.bincount(index[inside], weight[inside], len(self._held))
        self._looks[view] += 1
        self._held[view] += held[view]

    def forget(self, from_m: float) -> None:
        """Forget what was seen from an s on."""
        beyond = slice(max(0, round(from_m / BIN_M) - self._first), None)
        self._held[beyond] = self._looks[beyond] = 0.0

    def strip(self) -> tuple[Floats, Floats, NDArray[np.bool_]]:
        """s of each bin's far edge, whole plants in it, and whether it was ever in view; shape (bins,)."""
        s_m = (self._first + 1 + np.arange(len(self._held))) * BIN_M
        seen = self._looks > 0
        mean = np.divide(self._held, self._looks, out=np.zeros(len(seen)), where=seen)
        return np.asarray(s_m, dtype=float), np.asarray(mean, dtype=float), np.asarray(seen)

    def _keep_up(self, far_m: float) -> None:
        """Let the strip reach as far as is seen; what lies furthest behind is dropped."""
        beyond = round(far_m / BIN_M) - self._first - len(self._held)
        if beyond <= 0:
            return
        self._first += beyond
        for values in (self._held, self._looks):
            values[:] = np.concatenate([values[beyond:], np.zeros(min(beyond, len(values)))])
