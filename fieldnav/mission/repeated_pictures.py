"""Pictures that were shown before: a sensor's noise never comes twice, so these are not what the camera sees
now."""

from dataclasses import dataclass
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from fieldnav.odometry import Pose

REMEMBERED_S = 30.0
"""Longer than any buffer on the way from a camera holds pictures."""
MOVED_M = 0.02
"""The robot must have moved so far since: simulated noise may come twice while nothing moves."""
MIN_REPEATED = 2
"""Pictures shown again, one after the other, before it is said. The first may be a fault of a moment."""


@dataclass(frozen=True, slots=True)
class _Shown:
    stamp_s: float
    pose: Pose


class RepeatedPictures:
    """Remembers a checksum of each picture of one camera, and when it was shown first."""

    def __init__(self) -> None:
        self._shown: dict[int, _Shown] = {}
        self._last: int | None = None
        self._repeated = 0

    def age_s(self, sample: NDArray[np.uint8], stamp_s: float, pose: Pose) -> float | None:
        """How long ago the pictures that are shown now were shown first; None for new ones.

        sample: of the picture's pixels, enough that noise makes it one of a kind. The picture right before
        does not count: a camera that gives it again is frozen.
        """
        check = crc32(sample.tobytes())
        if check == self._last:
            return None
        self._last = check
        while self._shown and stamp_s - self._shown[oldest := next(iter(self._shown))].stamp_s > REMEMBERED_S:
            del self._shown[oldest]
        first = self._shown.setdefault(check, _Shown(stamp_s, pose))
        self._repeated = self._repeated + 1 if first.pose.distance_m(pose) >= MOVED_M else 0
        return stamp_s - first.stamp_s if self._repeated >= MIN_REPEATED else None
