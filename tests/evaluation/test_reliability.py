"""Confidence against how often it is right: bins, calibration error, and the picture of both."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.errors import OutputError
from fieldnav.evaluation.photographs import PhotographSet
from fieldnav.evaluation.reliability import JudgedRows, bins, calibration_error, counts_by_bin, reliability
from fieldnav.evaluation.reliability_plot import SET_COLOURS, draw_reliability


def rows(*groups: tuple[float, int, int]) -> JudgedRows:
    """Of each group: the confidence, how many rows have it, how many of them are right."""
    confidence = np.concatenate([np.full(count, given) for given, count, _ in groups])
    right = np.concatenate([np.arange(count) < good for _, count, good in groups])
    return JudgedRows(confidence, right)


def test_the_share_right_is_of_each_bin_by_itself() -> None:
    found = bins(rows((0.85, 4, 3), (0.25, 2, 0)))

    assert [(each.low, each.count, each.right, each.share) for each in found] == [
        (0.2, 2, 0, 0),
        (0.8, 4, 3, 0.75),
    ]


@pytest.mark.parametrize("given", [k / 10 for k in range(10)])
def test_a_confidence_on_the_border_belongs_to_the_bin_above(given: float) -> None:
    assert counts_by_bin(rows((given, 1, 1))).argmax() == round(given * 10)


def test_full_confidence_belongs_to_the_last_bin() -> None:
    assert counts_by_bin(rows((1.0, 3, 3))).tolist() == [0] * 9 + [3]


def test_confidence_that_keeps_its_word_has_no_error() -> None:
    assert calibration_error(rows((0.75, 4, 3), (0.5, 10, 5))) == pytest.approx(0)


def test_the_calibration_error_weighs_bins_by_their_rows() -> None:
    assert calibration_error(rows((0.9, 3, 0), (0.5, 1, 1))) == pytest.approx((3 * 0.9 + 0.5) / 4)


def test_errors_of_two_rows_in_one_bin_even_out_but_not_of_two_bins() -> None:
    assert calibration_error(rows((0.5, 2, 1))) == pytest.approx(0)
    assert calibration_error(rows((0.45, 1, 1), (0.55, 1, 0))) == pytest.approx(0.55)


def test_few_rows_make_an_uncertain_share_even_when_all_are_right() -> None:
    few, many = (bins(rows((0.95, count, count)))[0].standard_error for count in (3, 300))

    assert few > 0.1 and 0 < many < 0.01


def test_every_bin_and_the_calibration_error_are_figures() -> None:
    figures = reliability(rows((0.85, 4, 3), (0.25, 2, 0)))

    assert [(figure.metric, figure.value) for figure in figures[:-1]] == [
        ("share right of rows given 0.2 to 0.3", 0),
        ("share right of rows given 0.8 to 0.9", 0.75),
    ]
    assert figures[-1].metric == "expected calibration error"
    assert figures[-1].value == pytest.approx((4 * 0.1 + 2 * 0.25) / 6)


def test_the_figures_of_one_set_name_it() -> None:
    assert {
        figure.case for figure in reliability(rows((0.85, 4, 3)), "photographs near the robot's view")
    } == {"reliability of confidence: photographs near the robot's view"}


def test_every_set_of_photographs_with_rows_has_a_colour_of_its_own() -> None:
    with_truth = [photographs for photographs in PhotographSet if photographs.truth]

    assert len(set(SET_COLOURS)) == len(SET_COLOURS) == len(with_truth)


def test_the_picture_is_drawn(tmp_path: Path) -> None:
    path = tmp_path / "reliability.png"

    draw_reliability(path, {"one": rows((0.85, 4, 3)), "other": rows((0.25, 2, 0))})

    drawn = cv2.imread(str(path))
    assert drawn is not None and drawn.shape[0] > 800 and drawn.std() > 5


def test_a_picture_that_cannot_be_written_is_said_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"none/reliability\.png: cannot be written"):
        draw_reliability(tmp_path / "none" / "reliability.png", {"one": rows((0.85, 4, 3))})
