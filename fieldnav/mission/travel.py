"""What the wheels say the robot does: its twist, and how far it has come since the run began."""

from math import hypot

from fieldnav.control.kinematics import body_twist
from fieldnav.messages import STANDSTILL, Twist, WheelReport, WheelSetpoint
from fieldnav.odometry import Pose, Track
from fieldnav.settings.robot import Robot

STANDING_MPS = 0.01
"""Slower than this the robot stands; one motor revolution a minute is 0.5 mm/s. Our choice."""
STANDING_RPS = 0.01
"""The same for turning, half a degree a second."""
HEARD_S = 0.1
"""A module that has been silent for longer may do something else than it said: five reports were lost."""
KEPT_POSES = 300
"""Six seconds of ticks: longer than pictures may be late that are still told to be so."""


class Travel:
    """Adds up the modules' reports: to bound manoeuvres and to carry what was seen along for a few metres."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._measured_s: float | None = None
        self._known = False
        self.heard = (
            False  # whether all modules have spoken just now, so that the pictures can be held against it
        )
        self.twist: Twist = STANDSTILL
        self.forward_m = 0.0
        self.sideways_m = 0.0
        self.pose = Pose()
        self.report = WheelReport()
        self.track = Track(KEPT_POSES)

    @property
    def standing(self) -> bool:
        """Whether all modules say that the robot stands; a silent module says nothing."""
        still = hypot(self.twist.vx_mps, self.twist.vy_mps) < STANDING_MPS
        return self._known and still and abs(self.twist.yaw_rate_rps) < STANDING_RPS

    def measure(self, now_s: float, report: WheelReport) -> None:
        """Take in the modules' newest words; while one is missing nothing is known and nothing added."""
        dt_s = 0.0 if self._measured_s is None else now_s - self._measured_s
        self._measured_s, self.report = now_s, report
        self._known = len(report.modules) == len(self._robot.modules)
        self.heard = self._known and all(now_s - said.stamp_s <= HEARD_S for said in report.modules.values())
        if not self._known:
            self.twist = STANDSTILL
            return
        states = {
            wheel: WheelSetpoint(said.speed_mps, said.steering_rad) for wheel, said in report.modules.items()
        }
        self.twist = body_twist(states, self._robot.geometry)
        self.forward_m += self.twist.vx_mps * dt_s
        self.sideways_m += self.twist.vy_mps * dt_s
        self.pose = self.pose.moved(self.twist, dt_s)
        self.track.add(now_s, self.pose)
