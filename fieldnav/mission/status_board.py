"""The newest status of a mission, kept as it goes."""

from math import hypot, isfinite

from fieldnav.mission.tick import Tick
from fieldnav.operator.status import Status
from states.names import text
from states.table import IDLE

MOST_WARNINGS = 8
"""The newest ones; the journal has all of them."""
LONGEST_TEXT = 400
"""Characters of a reason or a warning, so that a status stays a short line."""


class StatusBoard:
    """Watches a mission; costs next to nothing a tick, and makes a Status only when one is asked for."""

    def __init__(self, run: str, lanes: int) -> None:
        self._run, self._lanes = run, lanes
        self._tick: Tick | None = None
        self._since_s = 0.0
        self._distance_m = 0.0
        self._because = ""
        self._warnings: dict[str, None] = {}

    def watch(self, tick: Tick) -> None:
        """Take in a tick."""
        before = self._tick
        self._tick = tick
        if before is None or tick.change is not None or tick.state != before.state:
            self._since_s = tick.now_s
            self._because = tick.step.reason
        if before is not None:
            self._distance_m += abs(tick.forward_m - before.forward_m)
            self._distance_m += abs(tick.sideways_m - before.sideways_m)
        if tick.warning:
            self._warn(tick.warning)

    def status(
        self,
        now_s: float,
        because: str | None = None,
        battery_percent: float | None = None,
        lateness_s: float | None = None,
    ) -> Status:
        """How the mission stands, with what no tick tells.

        `because` is why the state was entered, for one entered between two ticks, as by the operator.
        """
        tick = self._tick
        if tick is None:
            return Status(self._run, text(IDLE), None, 0, self._lanes, 0, 0.0, 0.0)
        twist = tick.passed.motion.twist
        speed_mps = 0.0 if tick.passed.motion.hold else hypot(twist.vx_mps, twist.vy_mps)
        return Status(
            run=self._run,
            state=text(tick.state),
            since_s=_known(now_s - self._since_s),
            lane=tick.lane,
            lanes=self._lanes,
            rows=tick.rows,
            distance_m=_known(self._distance_m),
            speed_mps=_known(speed_mps),
            reason=(tick.passed.reason or because or self._because)[:LONGEST_TEXT],
            warnings=tuple(self._warnings),
            battery_percent=_known(battery_percent),
            lateness_s=_known(lateness_s),
        )

    def _warn(self, warning: str) -> None:
        """Keep a warning, once, and let the oldest go."""
        kept = warning[:LONGEST_TEXT]
        self._warnings.pop(kept, None)
        self._warnings[kept] = None
        if len(self._warnings) > MOST_WARNINGS:
            del self._warnings[next(iter(self._warnings))]


def _known(value: float | None) -> float | None:
    """The figure, which JSON must be able to hold."""
    return float(value) if value is not None and isfinite(value) else None
