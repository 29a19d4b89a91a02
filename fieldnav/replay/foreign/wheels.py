"""Wheels that nobody has recorded: straight, at a speed that is assumed or that odometry tells."""

from collections.abc import Callable, Mapping
from math import inf

from fieldnav.control.kinematics import wheel_setpoints
from fieldnav.messages import ModuleReport, Motion, Steering, Twist, Wheel, WheelReport, WheelSetpoint
from fieldnav.settings.robot import Robot

Moved = Callable[[float], Twist]
"""How the recorded robot moved at a second of the run."""


class AssumedWheels:
    """The Wheels port over a motion that does not depend on any command.

    In the first round they stand: the mission sets their steering mode then, as before it sets off.
    """

    ready = True
    taken_over = False
    stops = None

    def __init__(self, robot: Robot, moved: Moved) -> None:
        self._geometry, self._moved = robot.geometry, moved
        self._limits = robot.limits.model_copy(update={"speed_mps": inf})  # it is what another robot did
        self._stood = False

    def start(self, now_s: float) -> None:
        """Nothing to bring up."""

    def poll(self, now_s: float) -> WheelReport:
        """What modules would have said of the motion."""
        twist, self._stood = self._moved(now_s) if self._stood else Twist(), True
        motion = Motion(twist, Steering.OMNIDIRECTIONAL)
        turned = wheel_setpoints(motion, self._geometry, {}, self._limits)
        return WheelReport(
            {wheel: ModuleReport(now_s, each.speed_mps, each.steering_rad) for wheel, each in turned.items()}
        )

    def command(self, now_s: float, setpoints: Mapping[Wheel, WheelSetpoint]) -> None:
        """They do as they did."""

    def stop(self, now_s: float) -> None:
        """They do as they did."""

    def emergency_stop(self, now_s: float) -> None:
        """They do as they did."""

    def release_emergency_stop(self, now_s: float) -> None:
        """They do as they did."""

    def close(self) -> None:
        """Nothing to give back."""


def steadily(twist: Twist) -> Moved:
    """The same motion from beginning to end."""
    return lambda now_s: twist
