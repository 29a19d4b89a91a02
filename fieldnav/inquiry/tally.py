"""What a run's journal adds up to: transitions in each lane, by what margins they came, faults."""

from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field

from fieldnav.inquiry.chances import deciding
from fieldnav.inquiry.stops import fault_of, is_note, is_stop
from fieldnav.journal.entry import Line

NO_LANE = 0
OTHERWISE = "no fault named"


@dataclass(slots=True)
class LaneTally:
    """Of one lane; coastings: how often its rows were lost."""

    transitions: int = 0
    coastings: int = 0
    holds: int = 0
    stops: int = 0


@dataclass(slots=True)
class Tally:
    """margins: of each event, and each condition that made it, in the condition's unit, in order.

    faults, holds: how often each kind stopped the mission, or held its wheels without changing its state.
    """

    lanes: dict[int, LaneTally] = field(default_factory=dict)
    margins: dict[tuple[str, str, str], list[float]] = field(default_factory=lambda: defaultdict(list))
    faults: Counter[str] = field(default_factory=Counter)
    holds: Counter[str] = field(default_factory=Counter)

    def add(self, line: Line) -> None:
        """Take in a line of the journal."""
        lane = self.lanes.setdefault(line.lane or NO_LANE, LaneTally())
        fault = fault_of(line)
        if is_stop(line):
            lane.stops += 1
            self.faults[fault.value if fault else OTHERWISE] += 1
        elif is_note(line):
            lane.holds += 1
            self.holds[fault.value if fault else line.event] += 1
        if is_note(line):
            return
        lane.transitions += 1
        lane.coastings += line.target.endswith(".Coasting")
        for condition in deciding(line.event, line.evidence):
            if condition.margin is not None:
                self.margins[line.event, condition.name, condition.unit].append(condition.margin)


def tally(lines: Iterable[Line]) -> Tally:
    """Of all of a run's lines."""
    made = Tally()
    for line in lines:
        made.add(line)
    return made
