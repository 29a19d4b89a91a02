"""The run's seconds as nanoseconds of the wall clock, and back."""

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from math import isfinite

NS_PER_S = 1_000_000_000
NS_PER_US = 1_000
EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
LAST_NS = 1 << 62
"""In the year 2116; what is reckoned from it still fits into 63 bits."""


@dataclass(frozen=True, slots=True)
class Stamps:
    """Counts from the moment at which the run began; there and back a stamp changes by half a nanosecond."""

    begun_ns: int

    @classmethod
    def since(cls, begun_utc: datetime) -> "Stamps":
        return cls((begun_utc - EPOCH) // timedelta(microseconds=1) * NS_PER_US)

    def to_ns(self, stamp_s: float) -> int:
        """Nanoseconds since 1970, within what can be written; also of an infinite stamp."""
        if not isfinite(stamp_s):
            return LAST_NS if stamp_s > 0 else 0
        return min(max(self.begun_ns + round(stamp_s * NS_PER_S), 0), LAST_NS)

    def to_s(self, log_time_ns: int) -> float:
        """The run's seconds."""
        return (log_time_ns - self.begun_ns) / NS_PER_S
