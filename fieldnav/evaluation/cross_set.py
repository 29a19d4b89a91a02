"""Confidence across sets: the judge of rows is fitted to all sets of photographs but one, tried on that."""

from collections.abc import Mapping, Sequence

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure, LeftOut, Plan, Progress, Report, one_by_one
from fieldnav.evaluation.found_rows import LEAST_CONFIDENCE
from fieldnav.evaluation.judge_fit import judged_rows, left_out, reported
from fieldnav.evaluation.judged_candidates import JudgedPicture, judged_picture
from fieldnav.evaluation.judged_photographs import cases_of
from fieldnav.evaluation.photographs import PhotographSet
from fieldnav.evaluation.reliability import calibration_error
from fieldnav.perception.comb.row_judge import RowJudge

PART = "judge fitted to the other sets"
FEWEST_SETS = 2
PERCENT = 100.0


def cross_set(plan: Plan, progress: Progress) -> Report:
    """Each set's figures by a judge that has not seen it; not in a quick run. Raises SettingsError."""
    if plan.quick:
        return Report((), (LeftOut(PART, "a quick run leaves it out"),))
    cases = cases_of(plan)
    if len(cases) < FEWEST_SETS:
        return Report((), (LeftOut(PART, "there are fewer than two sets of photographs"),))
    sets = {
        title: [judged_picture(*case) for case in one_by_one(f"{PART}: {title}", of_set, progress)]
        for title, of_set in cases.items()
    }
    return Report(tuple(figures_of(sets)))


def figures_of(sets: Mapping[str, Sequence[JudgedPicture]]) -> list[Figure]:
    """The figures of every set, each by a judge fitted to the others."""
    return [
        figure
        for title, pictures in sets.items()
        for figure in _figures(title, pictures, left_out(sets, title))
    ]


def _figures(title: str, pictures: Sequence[JudgedPicture], judge: RowJudge) -> list[Figure]:
    case = f"{PART}: {title}"
    if title == PhotographSet.NO_ROWS.title:
        share = float(np.mean([reported(picture, judge) for picture in pictures]))
        return [Figure(case, "pictures with a row reported (%)", share * PERCENT, better=Better.LOWER)]
    rows = judged_rows(pictures, judge)
    sure = rows.confidence >= LEAST_CONFIDENCE
    right = float(rows.right[sure].mean()) if sure.any() else float("nan")
    of_right = float(sure[rows.right].mean()) if rows.right.any() else float("nan")
    return [
        Figure(case, "rows reported that are right (share)", right),
        Figure(case, "right rows that are reported (share)", of_right),
        Figure(case, "expected calibration error", calibration_error(rows), better=Better.LOWER),
    ]
