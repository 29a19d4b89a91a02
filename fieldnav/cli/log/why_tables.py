"""The tables of `fieldnav log why`."""

from collections.abc import Sequence

from rich.table import Table
from rich.text import Text

from fieldnav.cli.console import table
from fieldnav.inquiry.asked import Asked
from fieldnav.inquiry.cause import reason_of
from fieldnav.inquiry.chances import Chance
from fieldnav.inquiry.evidence_rows import UNMET, Row
from fieldnav.inquiry.line_words import states_of
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.stops import is_note
from fieldnav.inquiry.words import judgements, measured
from fieldnav.journal.entry import Judged, Line
from fieldnav.settings.one_line import one_line

HOLDS = {True: "green", False: "red", None: ""}
"""Styles of a margin."""


def judged_table(title: str, rows: Sequence[Row]) -> Table:
    """Every quantity with value, threshold, margin, and the event that it is a condition of."""
    columns = ("quantity", "value", "threshold", "margin", "condition of")
    cells = [
        (
            Text(one_line(row.name), style="bold" if row.decided else ""),
            row.value,
            row.threshold,
            Text(one_line(row.margin), style=HOLDS[row.holds]),
            row.condition,
        )
        for row in rows
    ]
    return table(title, columns, cells, right=columns[1:-1])


def events_table(title: str, others: Sequence[Chance]) -> Table:
    """What did not happen, and by which condition."""
    rows = [
        (chance.event, " or ".join(_lacked(each) for each in chance.deciding), judgements(chance.deciding))
        for chance in others
    ]
    return table(title, ("event", "lacked", "by"), rows)


def _lacked(condition: Judged) -> str:
    if condition.margin is None:
        return "unknown"
    return measured(-condition.margin, condition.unit) if condition.margin else UNMET


def neighbours_table(asked: Asked) -> Table:
    """The line before, the line itself, which has been told of already, and the line after."""
    before = asked.before[-1] if asked.before else None
    rows = [
        ("before", *_told(before)),
        ("here", *_told(asked.line)[:2], _what(asked.line))
        if asked.happened
        else ("last", *_told(asked.line)),
        ("after", *_told(asked.after)),
    ]
    return table("", ("", "seq", "time", "what"), rows, right=("seq", "time"))


def _told(line: Line | None) -> tuple[str, str, str]:
    if line is None:
        return "", "", "nothing"
    because = reason_of(line)
    return str(line.seq), clock(line.stamp_s), _what(line) + (f": {because}" if because else "")


def _what(line: Line) -> str:
    return line.event if is_note(line) else f"{line.event}, {states_of(line)}"
