"""Whether the pictures move as is assumed: a speed that is off makes every distance wrong."""

from dataclasses import dataclass
from math import hypot
from statistics import median

from fieldnav.messages import CameraName, Floats
from fieldnav.mission.sudden_turn import textured
from fieldnav.mission.tick import Tick
from fieldnav.odometry import Pose
from fieldnav.perception.seen_motion import agreement, expected_px, patch
from fieldnav.perception.sidestep.wheel_motion import travelled
from fieldnav.settings.robot import Robot

APART_M = 0.03
"""Driven from one picture to the next that is compared. Measured: half of a true speed is then told to 3 %,
but at twice as far to 30 %, for plants that stand one behind the other are taken for each other."""
MOST_M = 0.12
"""Further apart nothing is compared."""
FEWEST = 20
"""Comparisons, a metre and more, before anything is said."""
OFF = 0.15
"""Of the speed; less is lost in how evenly the camera hangs and the ground lies."""


@dataclass(frozen=True, slots=True)
class _Before:
    camera: CameraName
    patch: Floats
    pose: Pose


class GroundSpeed:
    """An observer of the mission; compares the frames that were looked at."""

    def __init__(self, robot: Robot) -> None:
        self._cameras = robot.cameras.pinholes()
        self._before: _Before | None = None
        self._shares: list[float] = []

    def watch(self, tick: Tick) -> None:
        """Take in a fresh frame. One in which nothing can be told apart is passed over."""
        if tick.step.sight is None:
            return
        frame, before = tick.step.sight.frame, self._before
        driven_m = 0.0
        if before is not None and before.camera is frame.camera:
            driven_m = hypot(tick.pose.x_m - before.pose.x_m, tick.pose.y_m - before.pose.y_m)
            if driven_m < APART_M:
                return
        now = _Before(frame.camera, patch(frame.image), tick.pose)
        if before is not None and APART_M <= driven_m <= MOST_M and textured(before.patch).size:
            moved = travelled(before.pose, now.pose, now.camera)
            expected = expected_px(self._cameras[now.camera], moved)
            # Copies, for OpenCV weighs the pictures that it is given in place.
            self._shares.append(agreement(before.patch.copy(), now.patch.copy(), expected))
        self._before = now

    @property
    def share(self) -> float | None:
        """Of the assumed speed, at which the ground moves through the pictures; None if that is not known."""
        return median(self._shares) if len(self._shares) >= FEWEST else None


def as_assumed(share: float | None) -> bool:
    """Whether the pictures move about as fast as they should, or nobody knows."""
    return share is None or abs(share - 1) <= OFF
