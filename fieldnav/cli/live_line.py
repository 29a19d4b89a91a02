"""The line that tells what a run is doing, while it does it."""

import time

from rich.live import Live
from rich.text import Text

from fieldnav.mission.tick import Tick
from fieldnav.settings.one_line import one_line
from states.names import text

REDRAW_S = 0.25
STATE_WIDTH = 32
"""Columns of the longest state's name."""


class LiveLine:
    """State, lane, rows, distance, speed and time, redrawn a few times a second; a simulation's pace, too."""

    def __init__(self, live: Live, lanes: int, simulated: bool = True) -> None:
        self._live, self._lanes, self._simulated = live, lanes, simulated
        self._started = time.perf_counter()
        self._drawn = 0.0
        self._distance_m = 0.0
        self._at = (0.0, 0.0)
        self._warning = ""

    def watch(self, tick: Tick) -> None:
        """Take in a tick; draws when the state has changed or the last drawing is old enough."""
        at = (tick.forward_m, tick.sideways_m)
        self._distance_m += abs(at[0] - self._at[0]) + abs(at[1] - self._at[1])
        self._at = at
        self._warning = tick.warning or self._warning
        wall = time.perf_counter()
        if wall - self._drawn < REDRAW_S and tick.change is None:
            return
        self._drawn = wall
        twist = tick.passed.motion.twist
        pace = f"{tick.now_s / (wall - self._started):.1f} x real time" if self._simulated else ""
        line = Text.assemble(
            (f"{text(tick.state):{STATE_WIDTH}}", "bold"),
            f"lane {tick.lane}/{self._lanes}  rows {tick.rows}  {self._distance_m:6.1f} m  ",
            f"{abs(twist.vx_mps) + abs(twist.vy_mps):.2f} m/s  {tick.now_s:6.1f} s  ",
            pace,
            (f"  {one_line(self._warning)}", "yellow"),
        )
        self._live.update(line, refresh=True)
