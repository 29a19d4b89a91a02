"""A figure's cells in a table for people: so many decimals that what misses its goal does not read as met."""

from dataclasses import replace
from math import floor, isfinite, log10

from fieldnav.evaluation.benchmark import Better, Figure

DIGITS, MOST_DECIMALS = 3, 4
"""Of a figure that a person reads: significant digits, and decimals at most."""
FINEST = 6
"""Decimals at most of a figure that misses its goal by little."""


def value_cell(figure: Figure) -> str:
    """The value, and its deviation where there is one."""
    decimals = _decimals_beside_goal(figure)
    value = _number(figure.value, decimals)
    return value if figure.std is None else f"{value} +- {_number(figure.std, decimals)}"


def goal_cell(figure: Figure) -> str:
    """The goal; empty where there is none."""
    if figure.goal is None:
        return ""
    sign = ">=" if figure.better is Better.HIGHER else "<="
    spread = "" if figure.goal_std is None else f" +- {figure.goal_std:g}"
    return f"{sign} {figure.goal:g}{spread}"


def known_cell(figure: Figure) -> str:
    """The best value known; empty where there is none."""
    known = figure.best_known
    return "" if known is None else _number(known, _decimals(known))


def _number(value: float, decimals: int) -> str:
    return f"{value:.{decimals}f}" if isfinite(value) else "none"


def _decimals(value: float) -> int:
    """Decimals that show the leading digits of a value; its deviation is shown with as many."""
    size = floor(log10(abs(value))) if isfinite(value) and value else 0
    return min(MOST_DECIMALS, max(0, DIGITS - 1 - size))


def _decimals_beside_goal(figure: Figure) -> int:
    """So many that a value which misses its goal by little does not read as if it had met it."""
    decimals = _decimals(figure.value)
    if figure.met is not False or not isfinite(figure.value):
        return decimals
    return next((each for each in range(decimals, FINEST) if not _reads_as_met(figure, each)), FINEST)


def _reads_as_met(figure: Figure, decimals: int) -> bool:
    std = None if figure.std is None else round(figure.std, decimals)
    return bool(replace(figure, value=round(figure.value, decimals), std=std).met)
