"""Whether the wheels do what was asked of them, over time rather than in one tick."""

from math import hypot

from fieldnav.mission.gate import Passed

REFUSED_LIMIT_S = 2.0
"""The gate may refuse to move for so long before it counts as a fault. Our choice."""
STUCK_LIMIT_S = 3.0
"""A robot that is told to move and stands for so long is stuck. Our choice."""
MOVING_MPS = 0.03
"""Slower commands than this may well be lost in the wheels' friction. Our choice."""


class Progress:
    """Watches what the gate let through and whether the robot moves."""

    def __init__(self) -> None:
        self._refused_since_s: float | None = None
        self._stuck_since_s: float | None = None

    def complaint(self, now_s: float, passed: Passed, standing: bool) -> str:
        """Why the mission does not get on, in words; empty while it does."""
        self._refused_since_s = _since(self._refused_since_s, now_s, passed.reason is not None)
        twist = passed.motion.twist
        asked = not passed.motion.hold and hypot(twist.vx_mps, twist.vy_mps) > MOVING_MPS
        self._stuck_since_s = _since(self._stuck_since_s, now_s, asked and standing)
        if self._refused_since_s is not None and now_s - self._refused_since_s > REFUSED_LIMIT_S:
            return f"the gate does not let the wheels move: {passed.reason}"
        if self._stuck_since_s is not None and now_s - self._stuck_since_s > STUCK_LIMIT_S:
            return f"the wheels were told to move for {STUCK_LIMIT_S:.0f} s and stand still"
        return ""


def _since(since_s: float | None, now_s: float, holds: bool) -> float | None:
    """Since when a condition has held without a break."""
    if not holds:
        return None
    return now_s if since_s is None else since_s
