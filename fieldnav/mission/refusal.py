"""Why nothing may move: a twist that is no number, a frame or report that is not fresh, a module's fault."""

from dataclasses import dataclass
from math import isfinite

from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import Twist, Wheel, WheelReport
from fieldnav.settings.robot import Timeouts

FUTURE_S = 0.02
"""A frame's stamp may be so far ahead of the loop's clock: one tick, in which it may come; our choice."""


@dataclass(frozen=True, slots=True)
class Sight:
    """Age of the oldest frame that guides, None before the first; why no newer one can be gone by."""

    age_s: float | None
    trouble: Trouble | None = None


def refusal(
    now_s: float, twist: Twist, sight: Sight, report: WheelReport, timeouts: Timeouts
) -> Trouble | None:
    """Why nothing may move; None when all is well.

    An age that is no number or lies in the future is refused as one past its limit is: a stamp from a clock
    that is ahead would count as fresh for ever.
    """
    if not all(map(isfinite, (twist.vx_mps, twist.vy_mps, twist.yaw_rate_rps))):
        return Trouble(FaultKind.PROGRAM, f"the wanted twist is not finite: {twist}")
    return blind(sight, timeouts.frame_s) or _module_refusal(now_s, report, timeouts.motion_s)


def blind(sight: Sight, limit_s: float) -> Trouble | None:
    """Why nothing may be gone by what is seen; None where it may."""
    said = _too_old(sight.age_s, limit_s)
    if said and sight.trouble:
        return Trouble(sight.trouble.fault, f"{sight.trouble.said}; {said}")
    return Trouble(FaultKind.FRAMES_LATE, said) if said else None


def _too_old(age_s: float | None, limit_s: float) -> str:
    if age_s is None:
        return f"no frame has come yet, limit {limit_s:.2f} s"
    if age_s < -FUTURE_S:
        return f"newest frame is stamped {-age_s:.2f} s in the future, limit {FUTURE_S:.2f} s"
    if not age_s <= limit_s:
        return f"newest frame is {age_s:.2f} s old, limit {limit_s:.2f} s"
    return ""


def _module_refusal(now_s: float, report: WheelReport, limit_s: float) -> Trouble | None:
    for wheel in Wheel:
        module = report.modules.get(wheel)
        if module is None:
            return Trouble(FaultKind.MODULE_LATE, f"module {wheel.value} has not reported")
        age_s = now_s - module.stamp_s
        if age_s < 0:  # the driver stamps by the loop's own clock: none can be ahead of it
            said = f"module {wheel.value} last reported {-age_s:.2f} s in the future, limit 0 s"
            return Trouble(FaultKind.MODULE_LATE, said)
        if not age_s <= limit_s:
            said = f"module {wheel.value} last reported {age_s:.2f} s ago, limit {limit_s:.2f} s"
            return Trouble(FaultKind.MODULE_LATE, said)
        if module.trouble is not None:
            return module.trouble
    return None
