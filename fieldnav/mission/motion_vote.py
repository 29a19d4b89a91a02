"""A vote over frames: does the ground move through a camera's pictures as the wheels say?"""

from dataclasses import dataclass
from math import hypot

from fieldnav.messages import Floats, Frame
from fieldnav.mission.sudden_turn import textured
from fieldnav.odometry import Pose
from fieldnav.perception.seen_motion import agreement, expected_px, patch
from fieldnav.perception.sidestep.wheel_motion import travelled
from fieldnav.pinhole import Pinhole

LEAST_M, MOST_M = 0.045, 0.09
"""Of driving from one picture to the other: less is lost in shaking; after more, plants a row's spacing apart
may be taken for each other, and the ground then seems to go back."""
CLEAR, MOST = 0.5, 2.0
"""Of the expected motion, seen along it: at least the first is a vote, but against only up to the second,
beyond which two pictures have nothing in common."""
AGAINST = 4
"""Votes against more than for it that are believed."""
TRUSTED = 4
"""Votes for it that count at most, and from which on a look is taken only now and then."""
NOW_AND_THEN_M = 0.1


@dataclass(frozen=True, slots=True)
class _Before:
    patch: Floats
    pose: Pose


class MotionVote:
    """Compares a frame with an earlier one; looks closely until it trusts the camera, then less often."""

    def __init__(self, camera: Pinhole) -> None:
        self._camera = camera
        self._before: _Before | None = None
        self._votes = 0
        self._agreed_at = Pose()

    def suspect(self) -> None:
        """A frame looks like the one before it turned: half of what is needed, for rows look much alike.

        However often it is said, the other half must come of motion that was seen.
        """
        self._votes = min(self._votes, -(AGAINST // 2))

    def against(self, frame: Frame, pose: Pose) -> bool:
        """Whether it has become certain that the ground moves the other way."""
        resting = self._votes >= TRUSTED and _distance_m(self._agreed_at, pose) < NOW_AND_THEN_M
        if resting:
            return False
        if self._before is None or _distance_m(self._before.pose, pose) > MOST_M:
            self._before = _Before(patch(frame.image), pose)
            return False
        if _distance_m(self._before.pose, pose) < LEAST_M:
            return False
        self._count(frame, self._before, pose)
        return self._votes <= -AGAINST

    def _count(self, frame: Frame, before: _Before, pose: Pose) -> None:
        now = _Before(patch(frame.image), pose)
        moved = travelled(before.pose, pose, frame.camera)
        seen = 0.0
        if textured(before.patch).size and textured(now.patch).size:
            # Copies, for OpenCV weighs the pictures that it is given in place.
            seen = agreement(before.patch.copy(), now.patch.copy(), expected_px(self._camera, moved))
        if seen >= CLEAR:
            self._votes, self._agreed_at = min(self._votes + 1, TRUSTED), pose
        elif -MOST <= seen <= -CLEAR:
            self._votes = min(self._votes, 0) - 1  # long trust must not hide what has just happened
        self._before = now


def _distance_m(one: Pose, other: Pose) -> float:
    return hypot(one.x_m - other.x_m, one.y_m - other.y_m)
