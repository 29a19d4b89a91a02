"""What was judged, as the rows of a table: value, threshold, margin, and what it is a condition of."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from fieldnav.inquiry.chances import deciding
from fieldnav.inquiry.words import figure, measured
from fieldnav.journal.entry import Judged

MET, UNMET = "just met", "just not"
"""Instead of a margin of zero, which counts have all the time: a figure would not tell which of the two."""


@dataclass(frozen=True, slots=True)
class Row:
    """One quantity. decided: it is one of those that made the event; holds: None where it is no condition.

    value, margin: with the unit; threshold: behind the comparison that is wanted, of a condition.
    """

    name: str
    value: str
    threshold: str
    margin: str
    condition: str
    holds: bool | None
    decided: bool


def evidence_rows(evidence: Sequence[Judged], event: str) -> list[Row]:
    """Those that decided first, then the other conditions, then what was only looked at."""
    return condition_rows(evidence, deciding(event, evidence))


def condition_rows(evidence: Iterable[Judged], decided: Sequence[Judged]) -> list[Row]:
    """The same where it is known what decided."""
    return sorted((_row(judged, judged in decided) for judged in evidence), key=_rank)


def _rank(row: Row) -> tuple[bool, bool]:
    return not row.decided, row.holds is None


def _row(judged: Judged, decided: bool) -> Row:
    return Row(
        name=judged.name,
        value="unknown" if judged.value is None else measured(judged.value, judged.unit),
        threshold=_threshold(judged),
        margin=_margin(judged),
        condition=f"{judged.fires}, alone" if judged.fires and judged.alone else judged.fires,
        holds=judged.holds if judged.fires else None,
        decided=decided,
    )


def _threshold(judged: Judged) -> str:
    if judged.threshold is None:
        return ""
    return f"{judged.bound.value} {figure(judged.threshold)}" if judged.fires else figure(judged.threshold)


def _margin(judged: Judged) -> str:
    if judged.margin is None:
        return ""
    if judged.margin == 0:
        return MET if judged.holds else UNMET
    return f"{'+' if judged.margin > 0 else ''}{measured(judged.margin, judged.unit)}"
