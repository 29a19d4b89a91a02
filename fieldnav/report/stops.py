"""The stops, pauses, holds and notes of a run, each with its cause and what a person should then look at."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from fieldnav.faults import FaultKind
from fieldnav.inquiry.cause import HELD, KILLED, Cause, cause_of, led_here, reason_of
from fieldnav.inquiry.stops import is_note, is_stop
from fieldnav.journal.entry import Line
from fieldnav.report.naming import is_fault, is_latched
from fieldnav.report.spans import Span, lane_after
from fieldnav.report.words import sentence

MOST_BEFORE = 50
"""Lines before a stop in which its cause is looked for."""
RESET_ADVICE = "It is latched: it needs a reset before it can be resumed."


class Kind(Enum):
    """What the robot did; the value is how the report calls it."""

    STOP = "Stop"
    PAUSE = "Pause"
    HOLD = "Hold"
    NOTE = "Note"


@dataclass(frozen=True, slots=True)
class Stop:
    """One line of the journal at which the robot stopped, held, or noted what a person should know.

    seconds: how long it lasted, None where the journal does not tell. led: the transition just before, of
    which it is a consequence.
    """

    kind: Kind
    line: Line
    cause: Cause
    seconds: float | None
    led: Line | None = None

    @property
    def advice(self) -> str:
        """What a person should do, in sentences; empty where nothing is known."""
        found = sentence(self.cause.advice) if self.cause.fault else ""
        return f"{found} {RESET_ADVICE if is_latched(self.line.target) else ''}".strip()


def stops_of(lines: Sequence[Line], spans: Sequence[Span], killed_s: float | None = None) -> list[Stop]:
    """All of them in the order in which they came; killed_s: when the run ended without a word."""
    lasted = {span.entered.seq: span.seconds for span in spans[:-1]}
    found = []
    for index, line in enumerate(lines):
        kind = _kind(line)
        if kind in (Kind.STOP, Kind.PAUSE):
            before = lines[max(0, index - MOST_BEFORE) : index]
            found.append(
                Stop(kind, line, cause_of(line, before), lasted.get(line.seq), led_here(line, before))
            )
        elif kind is not None:
            found.append(Stop(kind, line, Cause(reason_of(line), cause_of(line, ()).fault), None))
    if killed_s is not None and lines:
        found.append(Stop(Kind.STOP, _killed(lines[-1], killed_s), Cause(str(KILLED), KILLED.fault), None))
    return found


def _killed(last: Line, at_s: float) -> Line:
    """The line that the journal would have ended with."""
    event = FaultKind.PROCESS_KILLED.value
    unknown = {"evidence": (), "frame": None, "command": None, "reason": "", "lane": lane_after(last)}
    return last.model_copy(update={**unknown, "stamp_s": at_s, "event": event, "source": last.target})


def _kind(line: Line) -> Kind | None:
    if is_stop(line):
        return Kind.STOP if is_fault(line.target) or is_note(line) else Kind.PAUSE
    if is_note(line):
        return Kind.HOLD if line.event == HELD else Kind.NOTE
    return None
