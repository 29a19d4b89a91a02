"""What the behaviours of one lane and of one switch hand to each other; made anew for each."""

from collections import Counter
from dataclasses import dataclass, field

from fieldnav.perception.passing_rows import Crossing
from fieldnav.perception.recognition import Descriptors
from fieldnav.perception.tracking import TrackedRows

OFTEN = 0.1
"""Share of a lane's frames: gaps hide a row in most of them at times, but not in nine of ten."""


@dataclass(slots=True)
class SwitchMemory:
    """One sidestep: the outermost row's features and the rows as they pass."""

    started_m: float
    reference: Descriptors | None = None
    crossing: Crossing | None = None
    seen_s: float | None = None
    """Stamp of the last frame in which the rows were followed."""


@dataclass(slots=True)
class LaneMemory:
    """One lane: the rows as each camera follows them, and how many rows were seen how often."""

    number: int
    under_way: bool = False
    entered_m: float | None = None
    leading: TrackedRows | None = None
    trailing: TrackedRows | None = None
    counts: Counter[int] = field(default_factory=Counter)
    switch: SwitchMemory | None = None

    @property
    def rows_passed(self) -> int:
        """New rows counted in this lane's switch so far."""
        return self.switch.crossing.passed if self.switch and self.switch.crossing else 0

    @property
    def rows(self) -> int:
        """C, the number of rows under the robot: the most that were seen together often; 0 before any was."""
        often = OFTEN * self.counts.total()
        return max((rows for rows, frames in self.counts.items() if frames >= often), default=0)
