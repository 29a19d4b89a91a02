"""How a line of a journal reads."""

from fieldnav.inquiry.stops import is_note
from fieldnav.journal.entry import Line


def in_lane(lane: int | None) -> str:
    """To be put behind a time; empty where no lane is known."""
    return "" if lane is None else f" in lane {lane}"


def states_of(line: Line) -> str:
    """From where to where, or, of a note, where."""
    return line.source if is_note(line) else f"{line.source} -> {line.target}"
