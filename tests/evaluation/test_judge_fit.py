"""The judge is fitted to candidates whose truth is known, and reports rows that it believes in."""

import numpy as np
import pytest

from fieldnav.evaluation.cross_set import figures_of
from fieldnav.evaluation.judge_fit import (
    fit_judge,
    fit_regression,
    judged_rows,
    left_out,
    reported,
)
from fieldnav.evaluation.judged_candidates import JudgedCandidate

RANDOM = np.random.default_rng(5)


def candidate(good: bool, rows: int = 3) -> JudgedCandidate:
    """One whose first feature, and whose rows' second, tell whether it is right."""
    features = RANDOM.normal(0, 1, 4)
    features[0] = RANDOM.normal(2.0 if good else -2.0, 1)
    of_rows = RANDOM.normal(0, 1, (rows, 3))
    of_rows[:, 1] += 2.0 if good else -2.0
    return JudgedCandidate(features, of_rows, float(good), np.full(rows, float(good)))


def pictures(count: int, with_rows: bool) -> list[list[JudgedCandidate]]:
    return [[candidate(False), candidate(with_rows), candidate(False)] for _ in range(count)]


def test_a_regression_finds_the_weights_that_made_its_targets() -> None:
    features = RANDOM.normal(0, 1, (4000, 2))
    odds = 1.5 * features[:, 0] - 0.5 * features[:, 1] + 0.3
    target = (RANDOM.random(4000) < 1 / (1 + np.exp(-odds))).astype(float)

    found = fit_regression(features, target)

    assert np.array(found.weight) / np.array(found.deviation) == pytest.approx([1.5, -0.5], abs=0.15)
    assert found.log_odds(np.zeros((1, 2))) == pytest.approx([0.3], abs=0.15)


def test_a_judge_reports_rows_where_they_are_and_none_elsewhere() -> None:
    judge = fit_judge([*pictures(200, True), *pictures(200, False)])

    assert np.mean([reported(each, judge) for each in pictures(100, True)]) > 0.9
    assert np.mean([reported(each, judge) for each in pictures(100, False)]) < 0.1
    assert not reported([], judge)


def test_its_confidence_is_that_of_rows_being_right() -> None:
    judge = fit_judge([*pictures(200, True), *pictures(200, False)])

    rows = judged_rows([*pictures(200, True), *pictures(200, False)], judge)

    assert rows.confidence.mean() == pytest.approx(rows.right.mean(), abs=0.05)
    assert rows.confidence[rows.right].mean() > rows.confidence[~rows.right].mean() + 0.2


def test_a_row_of_which_nobody_can_say_anything_is_left_out() -> None:
    judge = fit_judge([*pictures(30, True), *pictures(30, False)])
    known = candidate(True)
    half = JudgedCandidate(known.features, known.row_features, 1.0, np.array([1.0, np.nan, 0.0]))

    assert len(judged_rows([[half]], judge)) == 2


def test_the_set_that_is_left_out_has_no_part_in_the_judge() -> None:
    sets = {"rows": pictures(40, True), "none": pictures(40, False)}
    wrong = [
        [JudgedCandidate(c.features, c.row_features, 1 - c.worth, 1 - c.right) for c in p]
        for p in sets["rows"]
    ]

    judge = left_out(sets | {"odd": wrong}, "odd")

    assert np.mean([reported(each, judge) for each in pictures(50, True)]) > 0.9


def test_every_set_is_judged_by_what_was_fitted_to_the_others() -> None:
    sets = {
        "one": [*pictures(40, True), *pictures(40, False)],
        "two": [*pictures(40, True), *pictures(40, False)],
    }

    figures = {(figure.case, figure.metric): figure.value for figure in figures_of(sets)}

    for title in sets:
        case = f"judge fitted to the other sets: {title}"
        assert figures[case, "rows reported that are right (share)"] > 0.9
        assert figures[case, "right rows that are reported (share)"] > 0.9
        assert figures[case, "expected calibration error"] < 0.1
