"""A benchmark's figures, as a table for people and as one JSON object for programs."""

from collections.abc import Sequence
from dataclasses import asdict
from math import isfinite
from typing import Any

from rich.table import Table
from rich.text import Text

from fieldnav.cli.bench_cells import goal_cell, known_cell, value_cell
from fieldnav.cli.console import table
from fieldnav.evaluation.benchmark import Failure, Figure, LeftOut, Report

COLUMNS = ("case", "metric", "value", "goal", "best known", "source", "met")
FIGURES = ("value", "goal", "best known")
MET = {True: Text("yes", style="green"), False: Text("no", style="red"), None: Text("")}


def report_table(title: str, report: Report) -> Table:
    """A line a figure, then a line for each part that was left out and for each failure."""
    rows = _rows(report)
    return table(title, COLUMNS, rows, right=FIGURES)


def markdown(title: str, report: Report) -> str:
    """The same table for a document."""
    return as_markdown(title, COLUMNS, _rows(report), FIGURES)


def as_markdown(
    title: str, columns: Sequence[str], rows: Sequence[Sequence[str | Text]], right: Sequence[str]
) -> str:
    """A table for a document; the columns named in `right` hold figures."""
    rule = ["---:" if column in right else "---" for column in columns]
    lines = [[str(cell).replace("|", "\\|") for cell in row] for row in (columns, rule, *rows)]
    return "\n".join([title, "", *(f"| {' | '.join(line)} |" for line in lines)])


def _rows(report: Report) -> list[tuple[str | Text, ...]]:
    failures = report.failures or ()
    return [*map(_line, report.figures), *map(_absence, report.left_out), *map(_failed, failures)]


def _failed(failure: Failure) -> tuple[str | Text, ...]:
    said = Text(f"failed: {failure.reason}; again: {failure.again}", style="red")
    return (failure.case, said, *[""] * (len(COLUMNS) - 2))


def _absence(part: LeftOut) -> tuple[str | Text, ...]:
    said = Text(f"left out: {part.reason}", style="yellow")
    return (part.part, said, *[""] * (len(COLUMNS) - 2))


def _line(figure: Figure) -> tuple[str | Text, ...]:
    cells = value_cell(figure), goal_cell(figure), known_cell(figure)
    return figure.case, figure.metric, *cells, figure.source, MET[figure.met]


def document(name: str, commit: str, report: Report) -> dict[str, Any]:
    """The object that --json prints; a figure that could not be formed, as a mean of nothing, is null."""
    made: dict[str, Any] = {
        "bench": name,
        "commit": commit,
        "rows": [_row(figure) for figure in report.figures],
        "left_out": [asdict(part) for part in report.left_out],
    }
    if report.failures is not None:
        made["failures"] = [asdict(failure) for failure in report.failures]
    return made


def _row(figure: Figure) -> dict[str, Any]:
    row = {
        "case": figure.case,
        "metric": figure.metric,
        "value": _finite(figure.value),
        "std": _finite(figure.std),
        "goal": figure.goal,
        "best_known": figure.best_known,
        "source": figure.source,
        "met": figure.met,
    }
    if figure.goal_std is not None:
        row["goal_std"] = figure.goal_std
    return row


def _finite(value: float | None) -> float | None:
    """JSON has no NaN."""
    return value if value is not None and isfinite(value) else None
