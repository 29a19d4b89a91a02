"""Figures as a person reads them."""

from collections.abc import Iterable
from math import isfinite

from fieldnav.inquiry.words import measured

NOTHING = "\N{EN DASH}"
"""What a table has where there is nothing."""


def known(value: float | None, unit: str = "") -> str:
    """A value with the digits that count; the dash where it is not known."""
    if value is None or not isfinite(value):
        return NOTHING
    return measured(value, unit)


def fixed(value: float | None, decimals: int, unit: str = "") -> str:
    """A value of a table's column; the dash where it is not known."""
    if value is None or not isfinite(value):
        return NOTHING
    return f"{value:.{decimals}f} {unit}".rstrip()


def listed(parts: Iterable[str]) -> str:
    """The parts that say something, with commas between."""
    return ", ".join(part for part in parts if part)


def stopped(text: str) -> str:
    """With a full stop."""
    return text if text.endswith((".", "!", "?")) else f"{text}."


def sentence(text: str) -> str:
    """With a capital letter and a full stop."""
    return stopped(f"{text[:1].upper()}{text[1:]}") if text else ""
