"""Whether a camera's pictures can be gone by: lit, alive, of the right size, and moving as the wheels say."""

from math import hypot

import numpy as np
from numpy.typing import NDArray

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import Frame
from fieldnav.mission.motion_vote import MotionVote
from fieldnav.mission.sudden_turn import SuddenTurn
from fieldnav.odometry import Pose
from fieldnav.perception.pose.picture_quality import BLACK, WHITE
from fieldnav.pinhole import Pinhole

EVERY_PX = 8
"""Pixels of every so many rows and columns are looked at: 14,000 of them, whose noise never comes twice."""
FROZEN_M = 0.02
"""Driven under one and the same picture; a plant then moves by ten pixels."""
FROZEN_S = 5.0
"""The same picture for so long is none of a standing robot's either: leaves and light move."""


class PictureWatch:
    """Looks at each frame of one camera before anything is gone by it."""

    def __init__(self, camera: Pinhole) -> None:
        self._camera = camera
        self._vote, self._turn = MotionVote(camera), SuddenTurn()
        self._sample: NDArray[np.uint8] | None = None
        self._changed_s = 0.0
        self._changed_at = Pose()

    def objection(self, frame: Frame, pose: Pose) -> Trouble | None:
        """Why a frame taken at a pose must not guide.

        Raises DriverError for a picture of the wrong size, or one that moves against the wheels.
        """
        height, width = frame.image.shape[:2]
        if (width, height) != (self._camera.width_px, self._camera.height_px):
            wanted = f"{self._camera.width_px}x{self._camera.height_px}"
            raise DriverError(
                f"{frame.camera.value} camera gives {width}x{height}, its file says {wanted}",
                FaultKind.CAMERA_SIZE,
            )
        sample = frame.image[::EVERY_PX, ::EVERY_PX]
        found = self._unlit(frame, float(sample.mean())) or self._frozen(frame, sample, pose)
        if found is None and self._turn.happened(frame, pose):
            self._vote.suspect()
        if found is None and self._vote.against(frame, pose):
            raise DriverError(
                f"{frame.camera.value} camera: the ground moves against what the wheels say; it hangs upside "
                "down, or front and rear have changed places",
                FaultKind.CAMERA_TURNED,
            )
        return found

    def _unlit(self, frame: Frame, brightness: float) -> Trouble | None:
        name = f"{frame.camera.value} camera: brightness {brightness:.0f} of 255"
        if brightness < BLACK:
            return Trouble(FaultKind.CAMERA_BLACK, f"{name}, limit {BLACK:.0f}")
        if brightness > WHITE:
            return Trouble(FaultKind.CAMERA_WHITE, f"{name}, limit {WHITE:.0f}")
        return None

    def _frozen(self, frame: Frame, sample: NDArray[np.uint8], pose: Pose) -> Trouble | None:
        if self._sample is None or not np.array_equal(sample, self._sample):
            self._sample, self._changed_s, self._changed_at = sample.copy(), frame.stamp_s, pose
            return None
        driven_m = hypot(pose.x_m - self._changed_at.x_m, pose.y_m - self._changed_at.y_m)
        same_s = frame.stamp_s - self._changed_s
        if driven_m <= FROZEN_M and same_s <= FROZEN_S:
            return None
        said = f"{frame.camera.value} camera: the same picture for {same_s:.2f} s and {driven_m:.2f} m"
        return Trouble(FaultKind.CAMERA_FROZEN, said)
