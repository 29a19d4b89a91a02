"""The gate: the only way from what a state wants to the wheels, and the only caller of their `command`."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, inf, pi, radians

from drivers.ports import Wheels
from fieldnav.control.kinematics import wheel_setpoints
from fieldnav.control.limits import limit
from fieldnav.faults import Trouble
from fieldnav.messages import STANDSTILL, Motion, Steering, Twist, Wheel, WheelReport, WheelSetpoint
from fieldnav.mission.refusal import Sight, refusal
from fieldnav.settings.robot import Robot

MODE_CHANGE_RIM_MPS = 0.02
"""Every wheel must report a rim speed below this, in m/s, before the steering mode may change.

Our choice: forty of the 0.5 mm/s steps in which TPDO1 tells it (one motor rpm), and less than half a
millimetre of rim in a tick of 20 ms.
"""

LONGEST_STEP_S = 0.1
"""A late tick may not make up for the time it lost: five ticks of 20 ms; our choice."""


@dataclass(frozen=True, slots=True)
class Passed:
    """What went out to the wheels; `refused` says why it is zero although the robot should move."""

    motion: Motion
    setpoints: Mapping[Wheel, WheelSetpoint]
    refused: Trouble | None = None

    @property
    def reason(self) -> str:
        """Why the wheels are held, in words; empty while they are not."""
        return str(self.refused) if self.refused else ""


class Gate:
    """Limits speed, acceleration and steering rate; refuses stale input; zero outside moving states."""

    def __init__(self, wheels: Wheels, robot: Robot) -> None:
        self._wheels = wheels
        self._geometry = robot.geometry
        self._timeouts = robot.timeouts
        top_mps = min(module.top_speed_mps for module in robot.modules.values())
        self._limits = robot.limits.model_copy(update={"speed_mps": min(robot.limits.speed_mps, top_mps)})
        self._steering_limit_rad = min(module.steering_limit_rad for module in robot.modules.values())
        self._aligned_rad = radians(robot.limits.steering_aligned_deg)
        self._steering = Steering.DIFFERENTIAL
        self._twist = STANDSTILL
        self._angles: dict[Wheel, float] = {}
        self._passed_s: float | None = None
        self._error_rad = inf

    @property
    def aligned(self) -> bool:
        """Whether the wheels stood as wanted, within the robot's tolerance, at the last pass."""
        return self._error_rad <= self._aligned_rad

    def pass_on(
        self, now_s: float, motion: Motion, moving: bool, sight: Sight, report: WheelReport
    ) -> Passed:
        """Send to the wheels what may be sent of `motion`, and say what that was.

        Raises DriverError when the wheels cannot be commanded.
        """
        dt_s = 0.0 if self._passed_s is None else min(max(now_s - self._passed_s, 0.0), LONGEST_STEP_S)
        self._passed_s = now_s
        present = {wheel: module.steering_rad for wheel, module in report.modules.items()}
        refused = refusal(now_s, motion.twist, sight, report, self._timeouts) if moving else None
        if refused is not None or not moving:
            return self._halt(now_s, present, refused)
        return self._drive(now_s, dt_s, motion, present, report)

    def halted(self) -> None:
        """The wheels have been told to stop without the gate: what follows begins from standstill."""
        self._twist, self._error_rad = STANDSTILL, inf

    def _halt(self, now_s: float, present: Mapping[Wheel, float], refused: Trouble | None) -> Passed:
        """Zero at once; the modules' own ramp makes it smooth."""
        self._twist, self._error_rad = STANDSTILL, inf
        return self._send(now_s, Motion(STANDSTILL, self._steering), self._standing(present), refused)

    def _drive(
        self, now_s: float, dt_s: float, motion: Motion, present: Mapping[Wheel, float], report: WheelReport
    ) -> Passed:
        if motion.steering is not self._steering:
            if not self._stands(report):
                self._error_rad = inf
                stopping = limit(Motion(STANDSTILL, self._steering), self._twist, dt_s, self._limits)
                return self._send_motion(now_s, dt_s, stopping, present)
            self._steering = motion.steering
        goal = self._wheels_for(motion, present)
        self._error_rad = max(abs(goal[wheel].steering_rad - angle) for wheel, angle in present.items())
        if self._twist == STANDSTILL and not self.aligned:
            turning = limit(Motion(motion.twist, motion.steering, hold=True), STANDSTILL, dt_s, self._limits)
            return self._send_motion(now_s, dt_s, turning, present)
        slowed = Motion(_scaled(motion.twist, self._readiness), motion.steering, motion.hold)
        return self._send_motion(now_s, dt_s, limit(slowed, self._twist, dt_s, self._limits), present)

    @property
    def _readiness(self) -> float:
        """Share of the speed that wheels so far from their angles may have: 1 if aligned, else the cosine."""
        return 1.0 if self.aligned else max(0.0, cos(min(self._error_rad, pi)))

    def _stands(self, report: WheelReport) -> bool:
        return self._twist == STANDSTILL and all(
            abs(module.speed_mps) < MODE_CHANGE_RIM_MPS for module in report.modules.values()
        )

    def _wheels_for(self, motion: Motion, present: Mapping[Wheel, float]) -> dict[Wheel, WheelSetpoint]:
        return wheel_setpoints(motion, self._geometry, present, self._limits, self._steering_limit_rad)

    def _standing(self, present: Mapping[Wheel, float]) -> dict[Wheel, WheelSetpoint]:
        """Zero at the present angles; a wheel whose angle nobody knows is left out."""
        self._angles = dict(present)
        return {wheel: WheelSetpoint(0.0, angle) for wheel, angle in present.items()}

    def _send_motion(
        self, now_s: float, dt_s: float, motion: Motion, present: Mapping[Wheel, float]
    ) -> Passed:
        self._twist = STANDSTILL if motion.hold else motion.twist
        most_rad = self._limits.steering_rate_rps * dt_s
        setpoints = {}
        for wheel, wanted in self._wheels_for(motion, present).items():
            before_rad = self._angles.get(wheel, present.get(wheel, wanted.steering_rad))
            step_rad = max(-most_rad, min(most_rad, wanted.steering_rad - before_rad))
            self._angles[wheel] = before_rad + step_rad
            setpoints[wheel] = WheelSetpoint(wanted.speed_mps, before_rad + step_rad)
        return self._send(now_s, motion, setpoints)

    def _send(
        self,
        now_s: float,
        motion: Motion,
        setpoints: Mapping[Wheel, WheelSetpoint],
        refused: Trouble | None = None,
    ) -> Passed:
        self._wheels.command(now_s, setpoints)
        return Passed(motion, setpoints, refused)


def _scaled(twist: Twist, share: float) -> Twist:
    return Twist(twist.vx_mps * share, twist.vy_mps * share, twist.yaw_rate_rps * share)
