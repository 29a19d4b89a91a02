"""Photographs with annotated rows: the figures of each set, and how reliable the confidence is."""

from collections.abc import Callable
from pathlib import Path

from fieldnav.evaluation.benchmark import Figure, LeftOut, Plan, Progress, Report
from fieldnav.evaluation.crbd import crbd
from fieldnav.evaluation.found_rows import Finder
from fieldnav.evaluation.lincoln import lincoln
from fieldnav.evaluation.near_nadir import near_nadir
from fieldnav.evaluation.photographs import PhotographSet
from fieldnav.evaluation.reliability import CASE, JudgedRows, reliability
from fieldnav.evaluation.reliability_plot import PICTURE, draw_reliability

Measured = tuple[list[Figure], JudgedRows]


def photographed_rows(plan: Plan, progress: Progress, find: Finder) -> Report:
    """The figures of every set of photographs there is. Raises SettingsError, OutputError for the picture."""
    measures: dict[PhotographSet, Callable[[Path], Measured]] = {
        PhotographSet.NEAR_NADIR: lambda folder: near_nadir(folder, find, progress),
        PhotographSet.CRBD: lambda folder: crbd(folder, find, progress, plan.quick),
        PhotographSet.LINCOLN: lambda folder: lincoln(folder, find, progress, plan.quick),
    }
    figures: list[Figure] = []
    left_out: list[LeftOut] = []
    judged: dict[str, JudgedRows] = {}
    for photographs, measure in measures.items():
        folder = photographs.folder(plan)
        if folder is None:
            left_out.append(photographs.absence(plan))
            continue
        of_set, judged[photographs.title] = measure(folder)
        figures += of_set
    if not any(map(len, judged.values())):
        return Report(tuple(figures), (*left_out, LeftOut(CASE, "no row was found in any photograph")))
    if plan.plots is not None:
        draw_reliability(plan.plots / PICTURE, judged)
    figures += [figure for title, rows in judged.items() if len(rows) for figure in reliability(rows, title)]
    return Report((*figures, *reliability(JudgedRows.joined(judged.values()))), tuple(left_out))
