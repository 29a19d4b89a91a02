"""Candidates of drawn pictures are judged by the rows that were drawn."""

import numpy as np
import pytest

from fieldnav.training.drawn_picture import draw
from fieldnav.training.judged_rows import judged, judged_pictures


@pytest.fixture(scope="module")
def of_field() -> list:
    seeds = [seed for seed in range(900, 930) if (draw(seed).heat[32:] > 120).mean() > 0.05][:4]
    return [judged(draw(seed)) for seed in seeds]


def test_the_rows_of_some_candidates_are_right(of_field: list) -> None:
    best = [max(each.worth for each in picture) for picture in of_field]

    assert np.mean(best) > 0.6
    assert all(0 <= each.worth <= 1 for picture in of_field for each in picture)


def test_each_row_is_right_or_wrong_or_hidden(of_field: list) -> None:
    for picture in of_field:
        for each in picture:
            assert len(each.right) == len(each.row_features)
            assert set(each.right[np.isfinite(each.right)]) <= {0.0, 1.0}


def test_no_row_is_right_in_a_picture_without_any() -> None:
    seed = next(seed for seed in range(900, 930) if not draw(seed).rows)

    for each in judged_pictures([seed])[0]:
        assert each.worth == 0
        assert not np.nansum(each.right)
