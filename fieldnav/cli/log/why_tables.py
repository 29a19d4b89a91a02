"""The tables of `fieldnav log why`."""

from collections.abc import Sequence

from rich.table import Table
from rich.text import Text

from fieldnav.cli.console import table
from fieldnav.inquiry.asked import Asked
from fieldnav.inquiry.cause import reason_of
from fieldnav.inquiry.chances import Chance
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.words import figure, judgement, judgements
from fieldnav.journal.entry import Judged, Line

WIDE = 80
"""Columns from which on value and threshold stand beside the quantity's name."""


def judged_table(title: str, evidence: Sequence[Judged], width: int) -> Table:
    """Every quantity with value, threshold, margin, and the event that it is a condition of; those first."""
    ordered = sorted(evidence, key=lambda judged: not judged.fires)
    if width < WIDE:
        narrow = [
            (Text(judgement(each), style=_style(each)), _margin(each), _event(each)) for each in ordered
        ]
        return table(title, ("quantity", "margin", "condition of"), narrow, right=("margin",))
    rows = [
        (Text(each.name, style=_style(each)), _value(each), _threshold(each), _margin(each), _event(each))
        for each in ordered
    ]
    columns = ("quantity", "value", "wanted", "margin", "condition of")
    return table(title, columns, rows, right=columns[1:-1])


def _style(judged: Judged) -> str:
    return "bold" if judged.holds and judged.fires else ""


def _event(judged: Judged) -> Text:
    return Text(f"{judged.fires}, alone" if judged.fires and judged.alone else judged.fires)


def _value(judged: Judged) -> Text:
    return Text("unknown" if judged.value is None else _with_unit(judged.value, judged.unit))


def _with_unit(value: float, unit: str) -> str:
    return f"{figure(value)} {unit}".rstrip()


def _threshold(judged: Judged) -> Text:
    """With the side that is wanted, of a condition."""
    if judged.threshold is None:
        return Text()
    return Text(
        f"{judged.bound.value} {figure(judged.threshold)}" if judged.fires else figure(judged.threshold)
    )


def _margin(judged: Judged) -> Text:
    """Green where the condition holds."""
    if judged.margin is None:
        return Text()
    return Text(f"{judged.margin + 0.0:+.3g}", style="green" if judged.holds else "red")


def events_table(title: str, others: Sequence[Chance]) -> Table:
    """What did not happen, and by which condition."""
    rows = [
        (chance.event, " or ".join(_lacked(each) for each in chance.deciding), judgements(chance.deciding))
        for chance in others
    ]
    return table(title, ("event", "lacked", "by"), rows)


def _lacked(condition: Judged) -> str:
    return "unknown" if condition.margin is None else _with_unit(-condition.margin, condition.unit)


def neighbours_table(asked: Asked) -> Table:
    """The line before, the line itself, the line after."""
    before = asked.before[-1] if asked.before else None
    lines = [("before", before), ("here" if asked.happened else "last", asked.line), ("after", asked.after)]
    rows = [(name, *_told(line)) for name, line in lines]
    return table("", ("", "seq", "time", "what"), rows, right=("seq", "time"))


def _told(line: Line | None) -> tuple[str, str, str]:
    if line is None:
        return "", "", "nothing"
    change = "" if line.source == line.target else f" {line.source} -> {line.target}"
    because = reason_of(line)
    what = f"{line.event}{change}" + (f": {because}" if because else "")
    return str(line.seq), clock(line.stamp_s), what
