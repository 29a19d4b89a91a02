"""A pose on the ground, and the poses that a robot lately had: dead reckoning from twists."""

from collections import deque
from dataclasses import dataclass
from math import cos, sin

from fieldnav.messages import Twist


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the robot's centre is, and its heading counter-clockwise from the frame's x."""

    x_m: float = 0.0
    y_m: float = 0.0
    heading_rad: float = 0.0

    def moved(self, twist: Twist, dt_s: float) -> "Pose":
        """The pose after driving a constant twist; exact to second order by turning half way first."""
        turn = twist.yaw_rate_rps * dt_s
        heading = self.heading_rad + turn / 2
        ahead, left = twist.vx_mps * dt_s, twist.vy_mps * dt_s
        return Pose(
            self.x_m + ahead * cos(heading) - left * sin(heading),
            self.y_m + ahead * sin(heading) + left * cos(heading),
            self.heading_rad + turn,
        )

    def between(self, later: "Pose", share: float) -> "Pose":
        """The pose at a share of the way to a later one."""
        return Pose(
            self.x_m + share * (later.x_m - self.x_m),
            self.y_m + share * (later.y_m - self.y_m),
            self.heading_rad + share * (later.heading_rad - self.heading_rad),
        )


class Track:
    """The poses of the last moments, so that a frame can be given the place where it was taken."""

    def __init__(self, kept: int) -> None:
        self._poses: deque[tuple[float, Pose]] = deque(maxlen=kept)

    def add(self, stamp_s: float, pose: Pose) -> None:
        """Take in the pose at a time later than all before."""
        self._poses.append((stamp_s, pose))

    def at(self, stamp_s: float) -> Pose:
        """The pose at a time; that at the nearest time kept where it lies beyond them."""
        later: tuple[float, Pose] | None = None
        for stamp, pose in reversed(self._poses):
            if stamp <= stamp_s:
                if later is None or later[0] == stamp:
                    return pose
                return pose.between(later[1], (stamp_s - stamp) / (later[0] - stamp))
            later = (stamp, pose)
        return later[1] if later else Pose()
