"""The memory that this process holds, and how it grows over a mission."""

from pathlib import Path
from resource import getpagesize

import numpy as np

from fieldnav.messages import Floats

GOAL_MB = 400.0
MEGABYTE, HOUR_S = 1e6, 3600.0
STATM = Path("/proc/self/statm")


def memory_mb() -> float:
    """What this process holds in memory; NaN where the system does not tell as Linux does."""
    if not STATM.exists():
        return float("nan")
    return int(STATM.read_text(encoding="ascii").split()[1]) * getpagesize() / MEGABYTE


def growth_mb(now_s: Floats, held_mb: Floats, settled: float) -> float:
    """What the memory held at those moments, shape (n,), grows by in an hour; NaN where it is not known.

    settled: the share of the time after which caches are full, and what memory still grows by is a leak.
    """
    later = now_s >= now_s[0] + settled * (now_s[-1] - now_s[0])
    if not np.isfinite(held_mb).all():
        return float("nan")
    return float(np.polyfit(now_s[later], held_mb[later], 1)[0] * HOUR_S)
