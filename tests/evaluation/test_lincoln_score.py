"""Curves against annotated curves: which are the same row, which count, and how far off they are."""

from collections.abc import Sequence

import numpy as np
import pytest

from fieldnav.evaluation.found_rows import UNMATCHED
from fieldnav.evaluation.lincoln_score import LincolnTally, judge, match_nearest_first, score, total
from fieldnav.messages import Floats

TOP, BOTTOM, WIDTH = 128.0, 511.0, 512.0


def straight(x_top: float, x_bottom: float | None = None, top: float = TOP, bottom: float = BOTTOM) -> Floats:
    """A row from image row `top` to image row `bottom`; upright without a second column."""
    return np.array([(x_top, top), (x_top if x_bottom is None else x_bottom, bottom)])


def shifted(rows: Sequence[Floats], by_px: float) -> list[Floats]:
    return [np.add(row, (by_px, 0.0)) for row in rows]


TRUE = [straight(100), straight(250), straight(400)]


def counts(tally: LincolnTally) -> tuple[int, int, int, int]:
    return tally.hits, tally.main_rows, tally.matched, tally.false_alarms


def test_the_annotated_rows_themselves_are_found_without_error() -> None:
    tally = score(TRUE, TRUE)

    assert counts(tally) == (3, 3, 3, 0)
    assert (tally.recall, tally.precision, tally.f1) == (1, 1, 1)
    assert tally.distance_px.max() == 0 and tally.turned_deg.max() == 0


@pytest.mark.parametrize(("by_px", "hits"), [(25.5, 3), (-25.5, 3), (25.7, 0), (-25.7, 0)])
def test_a_row_is_found_within_a_twentieth_of_the_width(by_px: float, hits: int) -> None:
    assert counts(score(shifted(TRUE, by_px), TRUE)) == (hits, 3, hits, 3 - hits)


def test_recall_is_over_rows_that_reach_the_lowest_quarter_and_precision_over_all_found() -> None:
    leaving = straight(60, 10, bottom=300)
    tally = score([TRUE[0], leaving], [*TRUE, leaving])

    assert counts(tally) == (1, 3, 2, 0)
    assert (tally.recall, tally.precision) == (pytest.approx(1 / 3), 1)
    assert tally.f1 == pytest.approx(0.5)


@pytest.mark.parametrize(("x", "false"), [(180, 1), (26, 1), (24, 0), (474, 1), (476, 0)])
def test_a_wrong_row_counts_within_half_a_gap_of_the_annotated_ones(x: float, false: int) -> None:
    assert counts(score([*TRUE, straight(x)], TRUE)) == (3, 3, 3, false)


@pytest.mark.parametrize(("x", "false"), [(299, 1), (301, 0)])
def test_beside_a_single_annotated_row_half_a_gap_is_fifty_pixels(x: float, false: int) -> None:
    assert score([straight(x)], TRUE[1:2]).false_alarms == false


def test_where_a_wrong_row_counts_is_told_where_it_enters_the_lowest_quarter() -> None:
    entering = straight(700, 600, top=0, bottom=384)

    assert score([entering], TRUE).false_alarms == 0
    assert score([straight(700, 320, top=0, bottom=384)], TRUE).false_alarms == 1


def test_where_nothing_is_annotated_every_row_is_wrong() -> None:
    assert counts(score([straight(-50), straight(200)], [])) == (0, 0, 0, 2)


def test_two_found_rows_of_one_annotated_row_are_one_hit() -> None:
    assert counts(score([TRUE[1], *shifted(TRUE[1:2], 5)], TRUE)) == (1, 3, 1, 1)


def test_the_nearest_pairs_come_first_even_where_others_would_make_more_pairs() -> None:
    distance = np.array([[2.0, 9.0], [1.0, 4.0], [30.0, 30.0]])

    assert match_nearest_first(distance, 8.0).tolist() == [UNMATCHED, 0, UNMATCHED]
    assert match_nearest_first(distance, 9.0).tolist() == [1, 0, UNMATCHED]
    assert match_nearest_first(np.empty((0, 2)), 9.0).tolist() == []


def test_rows_are_compared_over_the_height_of_the_annotation_only() -> None:
    far_off_above = np.array([(400.0, 0.0), (100.0, TOP), (100.0, BOTTOM)])

    assert score([far_off_above], TRUE).distance_px.tolist() == [0]


def test_a_row_found_in_part_is_carried_on_straight() -> None:
    part = straight(190, 240, top=200, bottom=400)
    whole = straight(190 - 72 / 4, 240 + 111 / 4)

    assert score([part], [whole]).distance_px[0] == pytest.approx(0, abs=1e-9)


def test_a_bend_that_both_have_is_no_error_and_one_that_is_missed_is() -> None:
    down = np.arange(TOP, BOTTOM + 1)
    bend = np.stack([250 + 60 * ((down - TOP) / (BOTTOM - TOP)) ** 2, down], axis=-1)

    assert score([bend], [bend]).distance_px[0] == 0
    assert score([straight(250, 310)], [bend]).distance_px[0] == pytest.approx(10, abs=0.1)


def test_points_may_come_in_any_order() -> None:
    assert score([TRUE[0][::-1]], [TRUE[0], TRUE[1][::-1]]).distance_px.tolist() == [0]


@pytest.mark.parametrize("degrees", [1.0, -3.0])
def test_the_angle_is_between_the_lines_fitted_to_both(degrees: float) -> None:
    aside = np.tan(np.radians(degrees)) * (BOTTOM - TOP) / 2

    assert score([straight(250 - aside, 250 + aside)], TRUE[1:2]).turned_deg[0] == pytest.approx(abs(degrees))


def test_nothing_found_has_no_precision_and_scores_nothing() -> None:
    tally = score(np.empty((0, 5, 2)), TRUE)

    assert counts(tally) == (0, 3, 0, 0)
    assert (tally.recall, tally.f1) == (0, 0) and np.isnan(tally.precision)


def test_the_tally_over_pictures_is_of_their_sums() -> None:
    both = total([score(TRUE, TRUE), score([straight(180)], TRUE)])

    assert counts(both) == (3, 6, 3, 1)
    assert (both.recall, both.precision) == (0.5, 0.75)
    assert counts(total([])) == (0, 0, 0, 0)


def test_a_row_beside_all_that_is_annotated_is_neither_right_nor_wrong() -> None:
    judged = judge([straight(180), TRUE[0], straight(-90)], TRUE)

    assert judged.true.tolist() == [UNMATCHED, 0, UNMATCHED]
    assert judged.counts.tolist() == [True, True, False]


def test_a_mirrored_picture_has_the_same_tally() -> None:
    found = [straight(110, 95), straight(180, 185), straight(260, 240)]
    mirrored = [[[WIDTH - 1, 0.0] + row * [-1.0, 1.0] for row in rows] for rows in (found, TRUE)]

    there, back = score(found, TRUE), score(*mirrored)

    assert counts(there) == counts(back)
    assert np.allclose(sorted(there.distance_px), sorted(back.distance_px))
    assert np.allclose(sorted(there.turned_deg), sorted(back.turned_deg))
