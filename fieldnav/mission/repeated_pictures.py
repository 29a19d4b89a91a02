"""Pictures that were shown before: a sensor's noise never comes twice, so these are not what the camera sees
now."""

from collections import deque
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
    check: int
    stamp_s: float
    pose: Pose


class RepeatedPictures:
    """Remembers a checksum of each picture of one camera."""

    def __init__(self) -> None:
        self._shown: deque[_Shown] = deque()
        self._repeated = 0

    def age_s(self, sample: NDArray[np.uint8], stamp_s: float, pose: Pose) -> float | None:
        """How long ago the pictures that are shown now were shown first; None for new ones.

        sample: of the picture's pixels, enough that noise makes it one of a kind. The picture right before
        does not count: a camera that gives it again is frozen.
        """
        now = _Shown(crc32(sample.tobytes()), stamp_s, pose)
        last = self._shown[-1] if self._shown else None
        if last is not None and last.check == now.check:
            return None
        found = next(
            (
                each
                for each in self._shown
                if each.check == now.check and each.pose.distance_m(pose) >= MOVED_M
            ),
            None,
        )
        self._repeated = self._repeated + 1 if found else 0
        self._shown.append(now)
        while stamp_s - self._shown[0].stamp_s > REMEMBERED_S:
            self._shown.popleft()
        return stamp_s - found.stamp_s if found and self._repeated >= MIN_REPEATED else None
