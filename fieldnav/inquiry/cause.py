"""Why the mission stopped: the reason that the stop's line gives, and what led to it in the lines before."""

from collections.abc import Sequence
from dataclasses import dataclass

from fieldnav.faults import FAULTS, FaultKind, Trouble
from fieldnav.inquiry.chances import deciding
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.stops import by_a_person, fault_of, is_note, is_stop, stands
from fieldnav.inquiry.words import judgements
from fieldnav.journal.entry import Judged, Line
from states.names import Event, Top

HELD_BEFORE_S, NOTED_BEFORE_S = 5.0, 30.0
"""A hold of the wheels, and another note, so long before a stop may have led to it. Our choice."""
LED_S = 0.2
"""A transition that follows so soon is a consequence of the one before. Our choice."""
HELD = "held by the gate"
UNKNOWN = "no reason is written down"
KILLED = Trouble(
    FaultKind.PROCESS_KILLED,
    "the journal ends without a stop, as when the process is killed or the power goes; "
    "the modules have stopped the wheels by themselves",
)


@dataclass(frozen=True, slots=True)
class Cause:
    """said: in plain words; fault: the one that it comes down to; lines: where it was written."""

    said: str
    fault: FaultKind | None = None
    lines: tuple[Line, ...] = ()

    @property
    def advice(self) -> str:
        """What a person should look at; empty where no fault is named."""
        return FAULTS[self.fault].advice if self.fault else ""


def cause_of(line: Line, before: Sequence[Line]) -> Cause:
    """Of a stop or any other line; before: the newest lines before it, in the order of the file."""
    said, fault = reason_of(line) or UNKNOWN, fault_of(line)
    if not is_stop(line):
        return Cause(said, fault, (line,))
    stopped = _stopped_already(line, before)
    if stopped is not None:
        first, leading = stopped
        deeper = cause_of(first, leading)
        said = f"{said}; it had stood since {clock(first.stamp_s)}: {deeper.said}"
        return Cause(said, fault or deeper.fault, (line, *deeper.lines))
    led = () if fault else _led_to(line, before)
    told = [f"{each.event} at {clock(each.stamp_s)}: {reason_of(each)}" for each in led]
    if told and not by_a_person(line):
        said = f"{said}, after {', and '.join(told)}"
        fault = next((found for each in led if (found := fault_of(each))), None)
    return Cause(said, fault, (line, *led))


def led_here(line: Line, before: Sequence[Line]) -> Line | None:
    """The transition without which this one would not have come, if it judged anything: one just before."""
    last = before[-1] if before else None
    if last is None or is_note(last) or not last.evidence:
        return None
    return last if line.stamp_s - last.stamp_s <= LED_S else None


def reason_of(line: Line) -> str:
    """What a line says of itself: its reason, and the conditions that made it where no fault did."""
    fault = fault_of(line)
    if fault is not None:
        return line.reason if line.reason.startswith(fault.value) else f"{fault.value}: {line.reason}"
    conditions = judgements(_worth_telling(line))
    if line.reason and conditions:
        return f"{line.reason} ({conditions})"
    return line.reason or conditions


def _worth_telling(line: Line) -> tuple[Judged, ...]:
    """The deciding conditions; of a check that failed what did not come up."""
    made = deciding(line.event, line.evidence)
    if line.event == Event.FAIL.value and line.source == Top.CHECKING.value:
        lacking = tuple(each for each in line.evidence if each.threshold is not None and not each.holds)
        return (*lacking, *made)
    return made


def _stopped_already(line: Line, before: Sequence[Line]) -> tuple[Line, Sequence[Line]] | None:
    """The stop in which the mission stood when this one came, and what lies before that."""
    found = None
    for index in range(len(before) - 1, -1, -1):
        if not stands(before[index]):
            break
        if is_stop(before[index]) and before[index] is not line:
            found = before[index], before[:index]
    return found


def _led_to(line: Line, before: Sequence[Line]) -> tuple[Line, ...]:
    """The notes that lie shortly before a stop which names no fault itself, oldest first, each once."""
    led: dict[str, Line] = {}
    for each in before:
        ago_s = line.stamp_s - each.stamp_s
        if is_note(each) and ago_s <= (HELD_BEFORE_S if each.event == HELD else NOTED_BEFORE_S):
            led[each.event] = each
    return tuple(led.values())
