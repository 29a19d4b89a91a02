"""How quantities and figures read."""

from collections.abc import Sequence

from fieldnav.journal.entry import Judged
from fieldnav.messages import Bound

BELOW = {Bound.AT_LEAST: "<", Bound.ABOVE: "<=", Bound.AT_MOST: ">", Bound.BELOW: ">="}
"""What is said of a condition that fails."""
WHOLE_FROM = 1000
"""Larger figures are shown without decimals."""


def decisive(evidence: Sequence[Judged]) -> list[Judged]:
    """The quantities held against a threshold; all of them when none was."""
    return [judged for judged in evidence if judged.threshold is not None] or list(evidence)


def judgement(judged: Judged) -> str:
    """A quantity as a person reads it: its value, which way it lies from its threshold, the unit."""
    unit = f" {judged.unit}" if judged.unit else ""
    if judged.value is None:
        return f"{judged.name} unknown"
    value = f"{judged.name} {figure(judged.value)}"
    if judged.threshold is None:
        return f"{value}{unit}"
    return f"{value} {_relation(judged, judged.value, judged.threshold)} {figure(judged.threshold)}{unit}"


def _relation(judged: Judged, value: float, threshold: float) -> str:
    """Of a condition the comparison that was made, where the figures shown are apart it alone."""
    if judged.fires and figure(value) == figure(threshold):
        return judged.bound.value if judged.holds else BELOW[judged.bound]
    return "<" if value < threshold else ">" if value > threshold else "="


def judgements(evidence: Sequence[Judged]) -> str:
    """Some quantities in one line."""
    return ", ".join(judgement(judged) for judged in evidence)


def figure(value: float) -> str:
    """Three digits."""
    value += 0.0  # minus zero is zero
    return f"{value:.3g}" if abs(value) < WHOLE_FROM else f"{value:.0f}"


def measured(value: float, unit: str) -> str:
    """A figure with its unit."""
    return f"{figure(value)} {unit}".rstrip()


def counted(number: int, one: str, many: str = "") -> str:
    """1 lane, 2 lanes."""
    return f"{number} {one if number == 1 else many or f'{one}s'}"
