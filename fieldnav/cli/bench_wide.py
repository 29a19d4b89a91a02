"""The figures of cases that are alike, a line a case and a column a metric: what each change bought."""

from collections.abc import Sequence

from rich.console import Group
from rich.text import Text

from fieldnav.cli.bench_cells import goal_cell, known_cell, value_cell
from fieldnav.cli.bench_report import as_markdown
from fieldnav.cli.console import table
from fieldnav.evaluation.benchmark import Figure, Report

CASE, GOAL, KNOWN = "case", "  goal", "  best known"
MISSED = " (missed)"
STYLES = {True: "green", False: "red", None: ""}

Row = list[str | Text]


def wide_table(title: str, report: Report) -> Group:
    """The table for a terminal; what was left out, and what failed, is a line below it."""
    columns, rows = _laid_out(report)
    notes = (Text(note, style="yellow") for note in _notes(report))
    return Group(table(title, columns, rows, right=columns[1:]), *notes)


def wide_markdown(title: str, report: Report) -> str:
    """The same for a document."""
    columns, rows = _laid_out(report)
    written = as_markdown(title, columns, rows, columns[1:])
    return "\n".join([written, *(f"\n{note}" for note in _notes(report))])


def _laid_out(report: Report) -> tuple[list[str], list[Row]]:
    """Columns and lines; below a case that has goals, those, and the best values known."""
    metrics = list(dict.fromkeys(figure.metric for figure in report.figures))
    rows: list[Row] = []
    for case in dict.fromkeys(figure.case for figure in report.figures):
        of = {figure.metric: figure for figure in report.figures if figure.case == case}
        rows.append([case, *(_value(of[metric]) if metric in of else "" for metric in metrics)])
        if all(figure.goal is None for figure in of.values()):
            continue
        rows.append([GOAL, *(goal_cell(of[metric]) if metric in of else "" for metric in metrics)])
        if any(figure.best_known is not None for figure in of.values()):
            rows.append([KNOWN, *(_known(of[metric]) if metric in of else "" for metric in metrics)])
    return [CASE, *metrics], rows


def _value(figure: Figure) -> Text:
    missed = MISSED if figure.met is False else ""
    return Text(value_cell(figure) + missed, style=STYLES[figure.met])


def _known(figure: Figure) -> str:
    return "" if figure.best_known is None else f"{known_cell(figure)} ({figure.source})"


def _notes(report: Report) -> Sequence[str]:
    left_out = [f"{part.part}: left out: {part.reason}" for part in report.left_out]
    failed = [f"{each.case}: failed: {each.reason}; again: {each.again}" for each in report.failures or ()]
    return left_out + failed
