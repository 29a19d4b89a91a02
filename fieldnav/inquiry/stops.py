"""Which lines of a journal are stops, and the faults that they name."""

from fieldnav.faults import FaultKind
from fieldnav.journal.entry import Line
from states.names import Top

STANDING = (Top.IDLE.value, Top.PAUSED.value, Top.FAULT.value, Top.FINISHED.value)
"""Outermost states in which nothing more happens without a person."""
A_PERSON = ("paused by ", "resumed by ", "reset by ", "stopped by ", "interrupted by ")
"""How the reasons of what a person asked for begin."""
BY_NAME = sorted(FaultKind, key=lambda kind: -len(kind.value))
"""The longest first: one may begin as another is called."""


def top(state: str) -> str:
    """The outermost state."""
    return state.partition(".")[0]


def is_stop(line: Line) -> bool:
    """Whether the mission came to a stop by it."""
    return stops(line.event, line.source, line.target)


def stops(event: str, source: str, target: str) -> bool:
    """Whether a line so named is a stop: a pause, a failure, or a disk with no room to write it on."""
    if event == FaultKind.DISK_FULL.value:
        return True
    return source != target and top(target) in (Top.PAUSED.value, Top.FAULT.value)


def is_note(line: Line) -> bool:
    """Whether it changed no state."""
    return line.source == line.target


def stands(line: Line) -> bool:
    """Whether the mission waited for a person after it."""
    return top(line.target) in STANDING or is_stop(line)


def fault_of(line: Line) -> FaultKind | None:
    """The fault that a line names, by its reason or, a note, by what it is called."""
    for kind in BY_NAME:
        if line.reason.startswith(f"{kind.value}: ") or line.event == kind.value:
            return kind
    return None


def by_a_person(line: Line) -> bool:
    """Whether a person asked for it."""
    return line.reason.startswith(A_PERSON)
