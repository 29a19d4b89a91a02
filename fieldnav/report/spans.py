"""Which state the run was in when, from the journal alone."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from fieldnav.inquiry.stops import is_note
from fieldnav.journal.entry import Line
from fieldnav.journal.phases import PHASE_COLOURS, phase_of
from fieldnav.report.naming import CENTRED


@dataclass(frozen=True, slots=True)
class Span:
    """One stay in a state; `entered` is the journal's line that led into it."""

    state: str
    lane: int | None
    from_s: float
    to_s: float
    entered: Line

    @property
    def seconds(self) -> float:
        return self.to_s - self.from_s

    @property
    def phase(self) -> str:
        return phase_of(self.state)


def spans_of(lines: Sequence[Line], end_s: float) -> list[Span]:
    """The states one after the other, the last one until `end_s`."""
    changes = [line for line in lines if not is_note(line)]
    ends = [*(line.stamp_s for line in changes), end_s][1:]
    return [
        Span(line.target, lane_after(line), line.stamp_s, max(to_s, line.stamp_s), line)
        for line, to_s in zip(changes, ends, strict=True)
    ]


def lane_after(line: Line) -> int | None:
    """The lane that the robot is in after a line, which names the one before."""
    return line.lane + 1 if line.lane is not None and line.event == CENTRED else line.lane


def end_of(lines: Sequence[Line], duration_s: float | None, others_s: Iterable[float]) -> float:
    """When the run ended, as far as anything tells; others_s: when it was still under way."""
    begin_s = lines[0].stamp_s if lines else 0.0
    known = [line.stamp_s for line in lines[-1:]]
    known += [] if duration_s is None else [begin_s + duration_s]
    return max([*known, *others_s], default=0.0)


def seconds_by_phase(spans: Iterable[Span]) -> dict[str, float]:
    """Time spent in each phase that occurs, in the order of the phases' colours."""
    spent = dict.fromkeys(PHASE_COLOURS, 0.0)
    for span in spans:
        spent[span.phase] += span.seconds
    return {phase: seconds for phase, seconds in spent.items() if seconds > 0}


def distance_m(lines: Iterable[Line]) -> float | None:
    """Way of the wheels from line to line; None where the journal does not tell it."""
    places = [(line.forward_m, line.sideways_m) for line in lines]
    known = [(ahead, aside) for ahead, aside in places if ahead is not None and aside is not None]
    if not known:
        return None
    return sum(abs(b[0] - a[0]) + abs(b[1] - a[1]) for a, b in pairwise(known))
