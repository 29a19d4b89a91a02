"""The memory that this process holds, and how it grows over a mission."""

from pathlib import Path
from resource import getpagesize

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure
from fieldnav.messages import Floats

GOAL_MB = 400.0
CACHES_FILLED = 2 / 3  # of the mission: from then on what memory still grows by is a leak
MEGABYTE, HOUR_S = 1e6, 3600.0
STATM = Path("/proc/self/statm")


def memory_mb() -> float:
    """What this process holds in memory; NaN where the system does not tell as Linux does."""
    if not STATM.exists():
        return float("nan")
    return int(STATM.read_text(encoding="ascii").split()[1]) * getpagesize() / MEGABYTE


def memory_figures(case: str, now_s: Floats, held_mb: Floats) -> list[Figure]:
    """The growth of what was held at those moments, shape (n,), and what that comes to in an hour."""
    later = now_s > now_s[-1] * CACHES_FILLED
    growth_mb = float(np.polyfit(now_s[later], held_mb[later], 1)[0] * HOUR_S)
    hour_mb = float(held_mb[-1] + growth_mb * max(0.0, 1 - now_s[-1] / HOUR_S))
    metric = "memory after an hour, from its growth so far (MB)"
    return [
        Figure(case, "memory, growth in an hour (MB)", growth_mb, better=Better.LOWER),
        Figure(case, metric, hour_mb, goal=GOAL_MB, better=Better.LOWER),
    ]
