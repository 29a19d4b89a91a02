"""Which true row a found one is, and which rows count as reported."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.evaluation.found_rows import UNMATCHED, match


def test_a_true_row_is_found_once_and_by_the_nearest() -> None:
    distance = np.array([[0.03], [0.01], [0.02]])

    assert match(distance, 0.05).tolist() == [UNMATCHED, 0, UNMATCHED]


def test_a_row_at_the_limit_is_none() -> None:
    assert match(np.array([[0.05, 1.0], [1.0, 0.049]]), 0.05).tolist() == [UNMATCHED, 1]


def test_a_row_gives_way_to_one_that_has_no_other_choice() -> None:
    distance = np.array([[0.010, 0.012], [0.011, 0.9]])

    assert match(distance, 0.05).tolist() == [1, 0]


@pytest.mark.parametrize("shape", [(0, 3), (3, 0), (0, 0)])
def test_nothing_matches_nothing(shape: tuple[int, int]) -> None:
    assert match(np.zeros(shape), 0.05).tolist() == [UNMATCHED] * shape[0]


def test_a_row_counts_from_a_confidence_of_one_half(photos: SimpleNamespace) -> None:
    found = photos.found([(10, 10, 0.49), (20, 20, 0.5), (30, 30, 0.9)])

    sure = found.sure()

    assert [line.x_top_px for line in sure.lines] == [20, 30]
    assert sure.paths_px[:, 0, 0].tolist() == [20, 30]
