"""Whether each wheel does what it was told: turns to its angle, and drives as its set-point says."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees, radians

from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import ModuleReport, Wheel, WheelReport, WheelSetpoint
from fieldnav.mission.drive_watch import DriveWatch, since
from fieldnav.mission.gate import Passed
from fieldnav.settings.robot import Geometry

FAR_RAD, FAR_S = radians(12), 0.6
"""Steering further from its set-point than this for so long is stuck: set-points move slower than modules
turn, so that a healthy wheel lags by 9 degrees at most. Our choice."""
OFF_SHARE, OFF_S = 0.9, 2.5
"""And so is one that is a little off for long: of the angle from which on the gate lets no wheel drive, or
the robot would wait for it for ever."""
FRESH_S = 0.1
"""An older report tells nothing of what the wheel does now: five were lost. Our choice."""


@dataclass(slots=True)
class _Turning:
    """Since when one wheel has been far from its angle, and off it."""

    far_since_s: float | None = None
    off_since_s: float | None = None


class WheelWatch:
    """Remembers what was sent, and holds the reports against it."""

    def __init__(self, steering_aligned_rad: float, geometry: Geometry) -> None:
        """steering_aligned_rad: wheels within this of their angles count as turned."""
        self._aligned_rad = steering_aligned_rad
        self._drives = DriveWatch(geometry)
        self.forget()

    def forget(self) -> None:
        """Somebody else moved the wheels: nothing that was sent counts any longer."""
        self._turning = {wheel: _Turning() for wheel in Wheel}
        self._setpoints: Mapping[Wheel, WheelSetpoint] = {}
        self._drives.forget()

    def sent(self, now_s: float, passed: Passed) -> None:
        """Take in what went out to the wheels."""
        self._setpoints = dict(passed.setpoints)
        self._drives.sent(now_s, self._setpoints)

    def trouble(self, now_s: float, report: WheelReport) -> Trouble | None:
        """The first wheel that does not obey; one that runs away before one that does not turn."""
        fresh = {wheel: said for wheel, said in report.modules.items() if now_s - said.stamp_s <= FRESH_S}
        return self._drives.trouble(now_s, fresh) or self._unturned(now_s, fresh)

    def _unturned(self, now_s: float, reports: Mapping[Wheel, ModuleReport]) -> Trouble | None:
        for wheel, turning in self._turning.items():
            if wheel not in reports:
                turning.far_since_s = turning.off_since_s = None
            elif self._stuck(now_s, wheel, turning, reports[wheel].steering_rad):
                off_deg = degrees(self._off_rad(wheel, reports[wheel].steering_rad))
                said = f"module {wheel.value} stands {off_deg:.0f} degrees from the angle it was told"
                return Trouble(FaultKind.STEERING_STUCK, said)
        return None

    def _off_rad(self, wheel: Wheel, steering_rad: float) -> float:
        point = self._setpoints.get(wheel)
        return abs(point.steering_rad - steering_rad) if point else 0.0

    def _stuck(self, now_s: float, wheel: Wheel, turning: _Turning, steering_rad: float) -> bool:
        off_rad = self._off_rad(wheel, steering_rad)
        turning.far_since_s = since(turning.far_since_s, now_s, off_rad > FAR_RAD)
        turning.off_since_s = since(turning.off_since_s, now_s, off_rad > OFF_SHARE * self._aligned_rad)
        far = turning.far_since_s is not None and now_s - turning.far_since_s >= FAR_S
        off = turning.off_since_s is not None and now_s - turning.off_since_s >= OFF_S
        return far or off
