"""A benchmark's figures, as a table for people and as one JSON object for programs."""

from dataclasses import asdict, replace
from math import floor, isfinite, log10
from typing import Any

from rich.table import Table
from rich.text import Text

from fieldnav.cli.console import table
from fieldnav.evaluation.benchmark import Better, Figure, LeftOut, Report

COLUMNS = ("case", "metric", "value", "goal", "best known", "source", "met")
FIGURES = ("value", "goal", "best known")
MET = {True: Text("yes", style="green"), False: Text("no", style="red"), None: Text("")}
DIGITS, MOST_DECIMALS = 3, 4
"""Of a figure that a person reads: significant digits, and decimals at most."""
FINEST = 6
"""Decimals at most of a figure that misses its goal by little."""


def report_table(title: str, report: Report) -> Table:
    """A line a figure, then a line for each part that was left out."""
    rows = [*map(_line, report.figures), *map(_absence, report.left_out)]
    return table(title, COLUMNS, rows, right=FIGURES)


def markdown(title: str, report: Report) -> str:
    """The same table for a document."""
    rows = [*map(_line, report.figures), *map(_absence, report.left_out)]
    rule = ("---:" if column in FIGURES else "---" for column in COLUMNS)
    lines = [COLUMNS, rule, *([str(cell).replace("|", "\\|") for cell in row] for row in rows)]
    return "\n".join([title, "", *(f"| {' | '.join(line)} |" for line in lines)])


def _absence(part: LeftOut) -> tuple[str | Text, ...]:
    said = Text(f"left out: {part.reason}", style="yellow")
    return (part.part, said, *[""] * (len(COLUMNS) - 2))


def _line(figure: Figure) -> tuple[str | Text, ...]:
    decimals = _decimals_beside_goal(figure)
    value = _number(figure.value, decimals)
    if figure.std is not None:
        value = f"{value} +- {_number(figure.std, decimals)}"
    sign = ">=" if figure.better is Better.HIGHER else "<="
    goal = "" if figure.goal is None else f"{sign} {figure.goal:g}"
    known = "" if figure.best_known is None else _number(figure.best_known, _decimals(figure.best_known))
    return figure.case, figure.metric, value, goal, known, figure.source, MET[figure.met]


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
    return bool(replace(figure, value=round(figure.value, decimals)).met)


def document(name: str, commit: str, report: Report) -> dict[str, Any]:
    """The object that --json prints; a figure that could not be formed, as a mean of nothing, is null."""
    return {
        "bench": name,
        "commit": commit,
        "rows": [_row(figure) for figure in report.figures],
        "left_out": [asdict(part) for part in report.left_out],
    }


def _row(figure: Figure) -> dict[str, Any]:
    return {
        "case": figure.case,
        "metric": figure.metric,
        "value": _finite(figure.value),
        "std": _finite(figure.std),
        "goal": figure.goal,
        "best_known": figure.best_known,
        "source": figure.source,
        "met": figure.met,
    }


def _finite(value: float | None) -> float | None:
    """JSON has no NaN."""
    return value if value is not None and isfinite(value) else None
