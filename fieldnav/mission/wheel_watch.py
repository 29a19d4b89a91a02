"""Whether each wheel does what it was told: turns to its angle, and no faster than its set-point."""

from dataclasses import dataclass
from math import degrees, radians

from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import Wheel, WheelReport, WheelSetpoint
from fieldnav.mission.gate import Passed

FAR_RAD, FAR_S = radians(12), 0.6
"""Steering further from its set-point than this for so long is stuck: set-points move slower than modules
turn, so that a healthy wheel lags by 9 degrees at most. Our choice."""
OFF_SHARE, OFF_S = 0.9, 2.5
"""And so is one that is a little off for long: of the angle from which on the gate lets no wheel drive, or
the robot would wait for it for ever."""
SLOWEST_RAMP_MPS2 = 0.75
"""A module slows down at least so fast; half of what public simulators have. Our choice."""
RUNAWAY_MPS, RUNAWAY_S = 0.15, 0.15
"""So much beyond what it was told, for so long: seven reports in a row. Our choice."""
FRESH_S = 0.1
"""An older report tells nothing of what the wheel does now: five were lost. Our choice."""


@dataclass(slots=True)
class _Told:
    """What one wheel may be doing after its latest set-points; since when it does not."""

    slowest_mps: float = 0.0
    fastest_mps: float = 0.0
    runs_since_s: float | None = None
    far_since_s: float | None = None
    off_since_s: float | None = None


class WheelWatch:
    """Remembers what was sent, and holds the reports against it."""

    def __init__(self, steering_aligned_rad: float) -> None:
        """steering_aligned_rad: wheels within this of their angles count as turned."""
        self._aligned_rad = steering_aligned_rad
        self._told = {wheel: _Told() for wheel in Wheel}
        self._setpoints: dict[Wheel, WheelSetpoint] = {}
        self._sent_s: float | None = None

    def sent(self, now_s: float, passed: Passed) -> None:
        """Take in what went out to the wheels."""
        ramp_mps = SLOWEST_RAMP_MPS2 * (0.0 if self._sent_s is None else max(0.0, now_s - self._sent_s))
        self._sent_s = now_s
        self._setpoints = dict(passed.setpoints)
        for wheel, told in self._told.items():
            point = self._setpoints.get(wheel)
            speed_mps = point.speed_mps if point else 0.0
            # A wheel that is slower than it was told, or stands, does not run away.
            told.slowest_mps = min(speed_mps, 0.0, told.slowest_mps + ramp_mps)
            told.fastest_mps = max(speed_mps, 0.0, told.fastest_mps - ramp_mps)

    def forget(self) -> None:
        """Somebody else moved the wheels: nothing that was sent counts any longer."""
        self.__init__(self._aligned_rad)  # type: ignore[misc]

    def trouble(self, now_s: float, report: WheelReport) -> Trouble | None:
        """The first wheel that does not obey."""
        for wheel, module in report.modules.items():
            told = self._told[wheel]
            if now_s - module.stamp_s > FRESH_S:
                told.runs_since_s = told.far_since_s = told.off_since_s = None
                continue
            found = self._runs_away(now_s, wheel, told, module.speed_mps)
            found = found or self._stuck(now_s, wheel, told, module.steering_rad)
            if found is not None:
                return found
        return None

    def _runs_away(self, now_s: float, wheel: Wheel, told: _Told, speed_mps: float) -> Trouble | None:
        inside = told.slowest_mps - RUNAWAY_MPS <= speed_mps <= told.fastest_mps + RUNAWAY_MPS
        told.runs_since_s = since(told.runs_since_s, now_s, not inside)
        if told.runs_since_s is None or now_s - told.runs_since_s < RUNAWAY_S:
            return None
        said = f"module {wheel.value} drives at {speed_mps:.2f} m/s, told {_told_mps(told):.2f} m/s"
        return Trouble(FaultKind.DRIVE_RUNAWAY, said)

    def _stuck(self, now_s: float, wheel: Wheel, told: _Told, steering_rad: float) -> Trouble | None:
        point = self._setpoints.get(wheel)
        off_rad = abs(point.steering_rad - steering_rad) if point else 0.0
        told.far_since_s = since(told.far_since_s, now_s, off_rad > FAR_RAD)
        told.off_since_s = since(told.off_since_s, now_s, off_rad > OFF_SHARE * self._aligned_rad)
        far = told.far_since_s is not None and now_s - told.far_since_s >= FAR_S
        off = told.off_since_s is not None and now_s - told.off_since_s >= OFF_S
        if not (far or off):
            return None
        said = f"module {wheel.value} stands {degrees(off_rad):.0f} degrees from the angle it was told"
        return Trouble(FaultKind.STEERING_STUCK, said)


def _told_mps(told: _Told) -> float:
    """The set-point that lies nearest to nothing."""
    return told.fastest_mps if abs(told.fastest_mps) > abs(told.slowest_mps) else told.slowest_mps


def since(since_s: float | None, now_s: float, holds: bool) -> float | None:
    """Since when a condition has held without a break."""
    if not holds:
        return None
    return now_s if since_s is None else since_s
