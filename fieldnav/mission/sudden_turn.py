"""Whether a camera's picture has been turned upside down from one frame to the next."""

from dataclasses import dataclass
from math import hypot

import cv2
import numpy as np

from fieldnav.messages import Floats, Frame
from fieldnav.odometry import Pose
from fieldnav.perception.seen_motion import patch

TEXTURE, COARSER_PX = 2.5, 3.0
"""Grey levels, standard deviation of what is finer than so many pixels of a patch; bare soil may show less,
and nothing can then be compared."""
REACH = 0.25
"""Of a patch's height, by which the ground may have moved in it, each way: driving, and shaking."""
NEAR_M, NEAR_RAD, NEAR_S = 0.045, 0.05, 20.0
"""Frames taken further apart show different ground, or the robot has swung too far in between. Wheels take
several seconds to turn across, and no camera is looked at meanwhile."""
ALIKE, MORE_ALIKE = 0.6, 0.03
"""Correlation of the patch with the one before it turned, and by how much that must exceed the plain one.
Measured on rendered fields of every crop, frame by frame: the plain one is higher by 0.14 to 0.7."""


@dataclass(frozen=True, slots=True)
class _Before:
    fine: Floats
    pose: Pose
    stamp_s: float

    def near(self, other: "_Before") -> bool:
        """Whether both show the same ground."""
        apart_m = hypot(self.pose.x_m - other.pose.x_m, self.pose.y_m - other.pose.y_m)
        turned_rad = abs(self.pose.heading_rad - other.pose.heading_rad)
        return apart_m <= NEAR_M and turned_rad <= NEAR_RAD and abs(self.stamp_s - other.stamp_s) <= NEAR_S


class SuddenTurn:
    """Compares each frame of one camera with the one before."""

    def __init__(self) -> None:
        self._before: _Before | None = None

    def happened(self, frame: Frame, pose: Pose) -> bool:
        """Whether this frame is like the one before only when that is turned."""
        now, before = _Before(textured(patch(frame.image)), pose, frame.stamp_s), self._before
        self._before = now if now.fine.size else before  # glare or bare soil for a moment hides nothing
        if before is None or not now.fine.size or not before.near(now):
            return False
        turned = _likeness(now.fine, before.fine[::-1, ::-1])
        return turned >= ALIKE and turned - _likeness(now.fine, before.fine) >= MORE_ALIKE


def textured(picture: Floats) -> Floats:
    """What is fine in a patch, without the lens's darkening towards its edge; empty where nothing is."""
    fine = picture - cv2.GaussianBlur(picture, (0, 0), COARSER_PX)
    return np.asarray(fine if float(fine.std()) >= TEXTURE else fine[:0], np.float32)


def _likeness(now: Floats, before: Floats) -> float:
    """The best correlation of the middle of one patch with any part of the other, -1 to 1."""
    reach_px = max(1, round(REACH * now.shape[0]))
    middle = np.ascontiguousarray(now[reach_px:-reach_px, reach_px:-reach_px])
    return float(cv2.matchTemplate(np.ascontiguousarray(before), middle, cv2.TM_CCOEFF_NORMED).max())
