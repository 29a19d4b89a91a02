"""The beat of the loop on the wall clock, and how late its rounds begin."""

import time
from collections.abc import Callable

import numpy as np

from fieldnav.journal.summary import LoopHealth
from fieldnav.mission.loop import TICK_S

BIN_S, BINS = 0.001, 1000
"""Lateness is counted in steps of a millisecond, up to a second."""
PERCENTILE = 99
MILLISECONDS, DIGITS = 1000, 1


class Pace:
    """Waits for each round's time. Rounds that were missed are left out: nothing is made up for."""

    def __init__(self, clock: Callable[[], float], wait: Callable[[float], None] = time.sleep) -> None:
        self._clock, self._wait = clock, wait
        self._due_s = clock()
        self._counts = np.zeros(BINS, np.int64)
        self.worst_s = 0.0

    def next(self) -> float:
        """Wait for the next round; the time at which it begins."""
        self._due_s += TICK_S
        now_s = self._clock()
        if now_s < self._due_s:
            self._wait(self._due_s - now_s)
            now_s = self._clock()
        late_s = max(0.0, now_s - self._due_s)
        self._counts[min(int(late_s / BIN_S), BINS - 1)] += 1
        self.worst_s = max(self.worst_s, late_s)
        if late_s > TICK_S:
            self._due_s = now_s
        return now_s

    def health(self) -> LoopHealth:
        """How late the rounds began."""
        rounds = int(self._counts.sum())
        reached = np.searchsorted(np.cumsum(self._counts), rounds * PERCENTILE / 100)
        return LoopHealth(
            rounds=rounds,
            late_p99_ms=round((float(reached) + 1) * BIN_S * MILLISECONDS, DIGITS),
            late_max_ms=round(self.worst_s * MILLISECONDS, DIGITS),
        )


class RunClock:
    """Seconds since a run began, by a clock that never jumps; a run taken up again goes on from a stamp.

    Also tells of jumps of the wall clock, by which nothing goes.
    """

    def __init__(self, begin_s: float = 0.0) -> None:
        self._origin_s = time.monotonic() - begin_s
        self._wall_s = time.time() - time.monotonic()

    def __call__(self) -> float:
        return time.monotonic() - self._origin_s

    def jumped_s(self) -> float:
        """By how much the wall clock has jumped since the last call."""
        before_s, self._wall_s = self._wall_s, time.time() - time.monotonic()
        return self._wall_s - before_s
