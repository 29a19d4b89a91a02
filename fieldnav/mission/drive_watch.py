"""Whether each wheel drives as it was told: no faster, no slower, and as the other wheels do.

Only what the modules report can be judged here. A wheel whose motor turns as told behind a broken chain
reports that it drives.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import copysign, cos, sin

from fieldnav.control.kinematics import body_twist
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import ModuleReport, Wheel, WheelSetpoint
from fieldnav.settings.robot import Geometry

SLOWEST_RAMP_MPS2 = 0.75
"""A module slows down at least so fast; half of what public simulators have. Our choice."""
RUNAWAY_MPS, RUNAWAY_S = 0.15, 0.15
"""So much beyond what it was told, for so long: seven reports in a row. Our choice."""
SETTLING_S = 0.2
"""A drive and its reports follow a set-point with this time constant at the latest. Our choice: ten ticks,
while the simulated modules take two and their own ramp is steeper than the gate's."""
TOLERANCE = 0.2
"""Of the set-point; a speed controller in good order keeps within a few percent. Our choice."""
ROUGH_MPS = 0.002
"""What a controller may be off at any speed: four of the steps in which TPDO1 tells it. Our choice."""
APART_M = 0.05
"""Of rim, beyond the tolerance: a quarter of a wheel's radius. Our choice: a wheel that stands on the way has
then let the others drive 6 cm on, one at 60 % of its set-point 25 cm, at any speed."""
LONGEST_STEP_S = 0.1
"""No more time is counted for a round than this; what happened meanwhile was not seen. Our choice."""


@dataclass(slots=True)
class _Drive:
    """What one wheel may be doing after its latest set-points, and how far it has not done it.

    slowest, fastest: within these it may still be on its way; due: so fast it must be by now at least.
    """

    told_mps: float = 0.0
    slowest_mps: float = 0.0
    fastest_mps: float = 0.0
    due_mps: float = 0.0
    runs_since_s: float | None = None
    behind_m: float = 0.0
    misfit_m: float = 0.0

    def sent(self, told_mps: float, passed_s: float) -> None:
        """Take in the next set-point."""
        ramp_mps = SLOWEST_RAMP_MPS2 * passed_s
        self.told_mps = told_mps
        # A wheel that is slower than it was told, or stands, does not run away.
        self.slowest_mps = min(told_mps, 0.0, self.slowest_mps + ramp_mps)
        self.fastest_mps = max(told_mps, 0.0, self.fastest_mps - ramp_mps)
        still_other_way = self.slowest_mps if told_mps > 0 else self.fastest_mps
        if still_other_way or self.due_mps * told_mps < 0:
            self.due_mps = 0.0
        elif abs(told_mps) <= abs(self.due_mps):
            self.due_mps = told_mps
        else:
            self.due_mps += (told_mps - self.due_mps) * min(1.0, passed_s / SETTLING_S)


class DriveWatch:
    """Remembers what was sent, and holds the reports against it and against each other.

    For each wheel it adds up the way by which it has fallen behind, and by which it does not fit the others.
    Ground that slows all wheels alike is no fault of a drive: the robot keeps its course.
    """

    def __init__(self, geometry: Geometry) -> None:
        self._geometry = geometry
        self.forget()

    def forget(self) -> None:
        """Begin afresh: what was sent before no longer counts."""
        self._drives = {wheel: _Drive() for wheel in Wheel}
        self._sent_s: float | None = None
        self._judged_s: float | None = None

    def sent(self, now_s: float, setpoints: Mapping[Wheel, WheelSetpoint]) -> None:
        """Take in what went out to the wheels; a wheel that is not mentioned was told to stand."""
        passed_s = 0.0 if self._sent_s is None else max(0.0, now_s - self._sent_s)
        self._sent_s = now_s
        for wheel, drive in self._drives.items():
            point = setpoints.get(wheel)
            drive.sent(point.speed_mps if point else 0.0, passed_s)

    def trouble(self, now_s: float, reports: Mapping[Wheel, ModuleReport]) -> Trouble | None:
        """The wheel that does not drive as it was told; one without a fresh report is not judged."""
        passed_s = 0.0 if self._judged_s is None else min(max(0.0, now_s - self._judged_s), LONGEST_STEP_S)
        self._judged_s = now_s
        for wheel, drive in self._drives.items():
            if wheel not in reports:
                drive.runs_since_s = None
            elif self._runs_away(now_s, drive, reports[wheel].speed_mps):
                return _runaway(wheel, drive, reports[wheel].speed_mps)
        for wheel, module in reports.items():
            drive = self._drives[wheel]
            lacking_mps = self._lacking_mps(wheel, module.speed_mps, reports)
            drive.behind_m = max(0.0, drive.behind_m + lacking_mps * passed_s)
        if len(reports) == len(Wheel):
            self._compare(passed_s, reports)
        return self._weakest(reports)

    def _runs_away(self, now_s: float, drive: _Drive, speed_mps: float) -> bool:
        inside = drive.slowest_mps - RUNAWAY_MPS <= speed_mps <= drive.fastest_mps + RUNAWAY_MPS
        drive.runs_since_s = since(drive.runs_since_s, now_s, not inside)
        return drive.runs_since_s is not None and now_s - drive.runs_since_s >= RUNAWAY_S

    def _lacking_mps(self, wheel: Wheel, speed_mps: float, reports: Mapping[Wheel, ModuleReport]) -> float:
        """By how much the wheel is too slow; negative where it is not."""
        due_mps = self._drives[wheel].due_mps
        if due_mps == 0:
            return 0.0
        enough_mps = (1 - TOLERANCE) * self._ground_share(wheel, reports) * abs(due_mps) - ROUGH_MPS
        return enough_mps - speed_mps * copysign(1.0, due_mps)

    def _ground_share(self, wheel: Wheel, reports: Mapping[Wheel, ModuleReport]) -> float:
        """Which share of its set-point the best of the other wheels reaches on this ground, at most all."""
        shares = [
            module.speed_mps / self._drives[other].due_mps
            for other, module in reports.items()
            if other is not wheel and abs(self._drives[other].due_mps) > ROUGH_MPS
        ]
        return min(1.0, max(0.0, *shares)) if shares else 1.0

    def _compare(self, passed_s: float, reports: Mapping[Wheel, ModuleReport]) -> None:
        """Hold each wheel's deviation against the motion of the body that the other three deviate by."""
        if all(drive.due_mps == 0 for drive in self._drives.values()):
            return
        fastest_mps = max(abs(drive.told_mps) for drive in self._drives.values())
        deviations = {
            wheel: WheelSetpoint(module.speed_mps - self._drives[wheel].due_mps, module.steering_rad)
            for wheel, module in reports.items()
        }
        allowed_mps = TOLERANCE * fastest_mps + ROUGH_MPS
        for wheel, drive in self._drives.items():
            beyond_mps = abs(misfit_mps(wheel, deviations, self._geometry)) - allowed_mps
            drive.misfit_m = max(0.0, drive.misfit_m + beyond_mps * passed_s)

    def _weakest(self, reports: Mapping[Wheel, ModuleReport]) -> Trouble | None:
        """The wheel that is furthest from its set-point, or from the others, where that is too far."""
        behind_m = {wheel: self._drives[wheel].behind_m for wheel in reports}
        misfit_m = {wheel: self._drives[wheel].misfit_m for wheel in reports}
        for apart_m, how in ((behind_m, "behind its set-point"), (misfit_m, "off what the other wheels do")):
            wheel = max(apart_m, key=lambda each: apart_m[each], default=None)
            if wheel is not None and apart_m[wheel] >= APART_M:
                speed_mps, told_mps = reports[wheel].speed_mps, self._drives[wheel].told_mps
                said = (
                    f"module {wheel.value} drives at {speed_mps:.2f} m/s, told {told_mps:.2f} m/s, "
                    f"and is {apart_m[wheel]:.2f} m {how}"
                )
                return Trouble(FaultKind.DRIVE_WEAK, said)
        return None


def misfit_mps(wheel: Wheel, states: Mapping[Wheel, WheelSetpoint], geometry: Geometry) -> float:
    """Along its rolling direction: what a wheel does less what the other wheels' rigid motion has it do."""
    others = {other: state for other, state in states.items() if other is not wheel}
    twist, (x, y) = body_twist(others, geometry), geometry.position_m(wheel)
    vx_mps, vy_mps = twist.vx_mps - twist.yaw_rate_rps * y, twist.vy_mps + twist.yaw_rate_rps * x
    state = states[wheel]
    return state.speed_mps - (vx_mps * cos(state.steering_rad) + vy_mps * sin(state.steering_rad))


def _runaway(wheel: Wheel, drive: _Drive, speed_mps: float) -> Trouble:
    faster = abs(drive.fastest_mps) > abs(drive.slowest_mps)
    told_mps = drive.fastest_mps if faster else drive.slowest_mps
    said = f"module {wheel.value} drives at {speed_mps:.2f} m/s, told {told_mps:.2f} m/s"
    return Trouble(FaultKind.DRIVE_RUNAWAY, said)


def since(since_s: float | None, now_s: float, holds: bool) -> float | None:
    """Since when a condition has held without a break."""
    if not holds:
        return None
    return now_s if since_s is None else since_s
