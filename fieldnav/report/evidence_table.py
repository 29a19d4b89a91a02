"""What was judged, as the rows of a table: value, threshold, margin, and what it is a condition of."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from fieldnav.inquiry.chances import deciding
from fieldnav.journal.entry import Judged
from fieldnav.report.words import known

AS_WORDS = {">=": "at least", ">": "above", "<=": "at most", "<": "below"}


@dataclass(frozen=True, slots=True)
class Row:
    """One quantity. decided: it is one of those that made the event; holds: None where it is no condition."""

    name: str
    value: str
    threshold: str
    margin: str
    condition: str
    holds: bool | None
    decided: bool


def evidence_rows(evidence: Sequence[Judged], event: str) -> list[Row]:
    """Those that decided first, then the other conditions, then what was only looked at."""
    decided = deciding(event, evidence)
    return sorted((_row(judged, judged in decided) for judged in evidence), key=_rank)


def condition_rows(conditions: Iterable[Judged], decided: Sequence[Judged]) -> list[Row]:
    """The conditions of one event."""
    return sorted((_row(judged, judged in decided) for judged in conditions), key=_rank)


def _rank(row: Row) -> tuple[bool, bool]:
    return not row.decided, row.holds is None


def _row(judged: Judged, decided: bool) -> Row:
    threshold = "" if judged.threshold is None else known(judged.threshold, judged.unit)
    if threshold and judged.fires:
        threshold = f"{AS_WORDS[judged.bound.value]} {threshold}"
    margin = judged.margin
    return Row(
        name=judged.name,
        value=known(judged.value, judged.unit),
        threshold=threshold,
        margin="" if margin is None else f"{'+' if margin > 0 else ''}{known(margin, judged.unit)}",
        condition=judged.fires,
        holds=judged.holds if judged.fires else None,
        decided=decided,
    )
