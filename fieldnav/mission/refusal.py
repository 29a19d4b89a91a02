"""Why nothing may move: a twist that is no number, a frame or report that is not fresh, a module's fault."""

from math import isfinite

from drivers.thorvald_protocol import flag_faults
from fieldnav.messages import Twist, Wheel, WheelReport
from fieldnav.settings.robot import Timeouts

FUTURE_S = 0.02
"""A frame's stamp may be so far ahead of the loop's clock: one tick, in which it may come; our choice."""


def refusal(
    now_s: float, twist: Twist, frame_age_s: float | None, report: WheelReport, timeouts: Timeouts
) -> str | None:
    """Why nothing may move, in words; None when all is well.

    `frame_age_s` is None before the first frame. An age that is no number or lies in the future is refused as
    one past its limit is: a stamp from a clock that is ahead would count as fresh for ever.
    """
    if not all(map(isfinite, (twist.vx_mps, twist.vy_mps, twist.yaw_rate_rps))):
        return f"the wanted twist is not finite: {twist}"
    return _frame_refusal(frame_age_s, timeouts.frame_s) or _module_refusal(now_s, report, timeouts.module_s)


def _frame_refusal(age_s: float | None, limit_s: float) -> str | None:
    if age_s is None:
        return f"no frame has come yet, limit {limit_s:.2f} s"
    if age_s < -FUTURE_S:
        return f"newest frame is stamped {-age_s:.2f} s in the future, limit {FUTURE_S:.2f} s"
    if not age_s <= limit_s:
        return f"newest frame is {age_s:.2f} s old, limit {limit_s:.2f} s"
    return None


def _module_refusal(now_s: float, report: WheelReport, limit_s: float) -> str | None:
    for wheel in Wheel:
        module = report.modules.get(wheel)
        if module is None:
            return f"module {wheel.value} has not reported"
        age_s = now_s - module.stamp_s
        if age_s < 0:  # the driver stamps by the loop's own clock: none can be ahead of it
            return f"module {wheel.value} last reported {-age_s:.2f} s in the future, limit 0 s"
        if not age_s <= limit_s:
            return f"module {wheel.value} last reported {age_s:.2f} s ago, limit {limit_s:.2f} s"
        if not module.healthy:
            faults = flag_faults(module.flags) or "emergency telegram"
            return f"module {wheel.value} is not healthy: {faults}"
    return None
