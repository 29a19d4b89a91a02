"""Whether the pictures move as is assumed: a speed that is off makes every distance wrong."""

from dataclasses import dataclass
from math import hypot
from statistics import median

from fieldnav.messages import CameraName
from fieldnav.mission.tick import Tick
from fieldnav.odometry import Pose
from fieldnav.perception.ground_view import GroundMap, GroundView
from fieldnav.perception.sidestep.wheel_motion import travelled
from fieldnav.settings.robot import Robot

APART_M = 0.03
"""Driven from one picture to the next that is compared."""
MOST_M = 0.12
"""Further apart nothing is compared: plants that stand one behind the other are then taken for each other."""
FEWEST = 20
"""Comparisons, a metre and more, before anything is said."""
OFF = 0.15
"""Of the speed; less is lost in how evenly the camera hangs and the ground lies."""
REACH = 2.5
"""Times the assumed motion, within which the ground is looked for."""


@dataclass(frozen=True, slots=True)
class _Before:
    camera: CameraName
    ground: GroundMap
    pose: Pose


class GroundSpeed:
    """An observer of the mission; compares the frames that were looked at."""

    def __init__(self, robot: Robot) -> None:
        self._views = {name: GroundView(camera) for name, camera in robot.cameras.pinholes().items()}
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
        now = _Before(frame.camera, self._views[frame.camera].look(frame.image), tick.pose)
        if before is not None and APART_M <= driven_m <= MOST_M:
            self._compare(before, now, driven_m)
        self._before = now

    def _compare(self, before: _Before, now: _Before, driven_m: float) -> None:
        view, moved = self._views[now.camera], travelled(before.pose, now.pose, now.camera)
        seen = view.motion(before.ground, now.ground, REACH * driven_m)
        if seen is not None and seen.found:
            left_m = moved.left_m + moved.turn_rad * view.middle_m
            along_m2 = seen.ahead_m * moved.ahead_m + seen.left_m * left_m
            self._shares.append(along_m2 / (moved.ahead_m**2 + left_m**2))

    @property
    def share(self) -> float | None:
        """Of the assumed speed, at which the ground moves through the pictures; None if that is not known."""
        return median(self._shares) if len(self._shares) >= FEWEST else None


def as_assumed(share: float | None) -> bool:
    """Whether the pictures move about as fast as they should, or nobody knows."""
    return share is None or abs(share - 1) <= OFF
