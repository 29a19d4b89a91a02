"""Whether the robot gets on: what it was asked to do, over time rather than in one tick."""

from math import hypot

from fieldnav.faults import FaultKind, Trouble
from fieldnav.mission.drive_watch import since
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

    def trouble(self, now_s: float, passed: Passed, standing: bool) -> Trouble | None:
        """Why the mission does not get on."""
        self._refused_since_s = since(self._refused_since_s, now_s, passed.refused is not None)
        twist = passed.motion.twist
        asked = not passed.motion.hold and hypot(twist.vx_mps, twist.vy_mps) > MOVING_MPS
        self._stuck_since_s = since(self._stuck_since_s, now_s, asked and standing)
        if passed.refused and self._refused_since_s is not None:
            held_s = now_s - self._refused_since_s
            if held_s > REFUSED_LIMIT_S:
                said = f"{passed.refused.said}; the wheels were held for {held_s:.1f} s"
                return Trouble(passed.refused.fault, said)
        if self._stuck_since_s is not None and now_s - self._stuck_since_s > STUCK_LIMIT_S:
            said = f"the wheels were told to move for {STUCK_LIMIT_S:.0f} s and stand still"
            return Trouble(FaultKind.STANDS_STILL, said)
        return None
