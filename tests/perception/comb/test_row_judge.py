"""Candidates are weighed by what both witnesses show on their rows and between them."""

import numpy as np
import pytest

from fieldnav.perception.comb.candidates import Candidate, Source, candidates_in
from fieldnav.perception.comb.row_contrast import agreement, contrast_of, explained, placed
from fieldnav.perception.comb.row_judge import Regression, choose_rows, measure, row_judge
from fieldnav.perception.comb.search_range import any_camera
from fieldnav.perception.row_network import RowHeat
from fieldnav.perception.vegetation import Cover
from fieldnav.settings.crop import Vegetation

WIDTH, HEIGHT, SPACING = 400, 240, 100


def upright(*columns: float, spacing: float = SPACING) -> Candidate:
    """Rows straight down the picture."""
    down = np.linspace(0, HEIGHT - 1, 10)
    paths = np.array([np.stack([np.full(10, column), down], axis=-1) for column in columns])
    return Candidate(paths, 0.0, WIDTH / spacing, Source.STRAIGHT)


def stripes(width: int, height: int, columns: tuple[float, ...]) -> np.ndarray:
    """A map with a stripe about each of these columns of a picture WIDTH wide."""
    at = (np.arange(width) + 0.5) / width * WIDTH
    shown = np.exp(-0.5 * (np.abs(at[:, None] - np.array(columns)).min(axis=1) / 8) ** 2)
    return np.tile(shown, (height, 1)).astype(np.float32)


ROWS = (50.0, 150.0, 250.0, 350.0)


def test_rows_stand_out_where_they_are_and_not_between() -> None:
    witness = stripes(96, 64, ROWS)

    there = contrast_of(placed(upright(*ROWS), WIDTH, HEIGHT), witness)
    beside = contrast_of(placed(upright(100.0, 200.0, 300.0), WIDTH, HEIGHT), witness)

    assert there.contrast.min() > 0.7
    assert there.evenness == pytest.approx(1)
    assert beside.contrast.max() < -0.7
    assert there.width < 0.4


def test_what_is_shown_is_explained_by_the_rows_that_show_it() -> None:
    witness = stripes(96, 64, ROWS)

    assert explained(placed(upright(*ROWS), WIDTH, HEIGHT), witness) > 0.9
    assert explained(placed(upright(50.0), WIDTH, HEIGHT), witness) < 0.4


def test_two_candidates_agree_as_far_as_their_rows_are_the_same() -> None:
    whole, half, other = (
        placed(upright(*columns), WIDTH, HEIGHT) for columns in (ROWS, ROWS[:2], (100.0, 200.0, 300.0))
    )

    assert agreement(whole, whole) == pytest.approx(1)
    assert agreement(whole, half) == pytest.approx(2 / 3)
    assert agreement(whole, other) == 0


def test_the_rows_that_both_witnesses_show_are_chosen() -> None:
    green = (stripes(WIDTH, HEIGHT, ROWS) * 120).astype(np.uint8)
    cover = Cover(green, 40.0, 15.0, WIDTH, HEIGHT)
    heat = RowHeat((stripes(96, 64, ROWS) * 255).astype(np.uint8), 0.99)
    candidates = [upright(100.0, 200.0, 300.0), upright(*ROWS), upright(20.0, spacing=300.0)]

    chosen = choose_rows(measure(candidates, cover, heat), row_judge())

    assert chosen is not None
    assert chosen.candidate is candidates[1]
    assert chosen.confidence.min() > 0.7


def test_nothing_is_chosen_from_nothing() -> None:
    assert choose_rows([], row_judge()) is None


def test_features_are_finite_in_odd_pictures() -> None:
    for image in (np.zeros((60, 90, 3), np.uint8), np.full((50, 400, 3), (30, 200, 40), np.uint8)):
        green = image[:, :, 1].copy()
        cover = Cover(green, 40.0, 15.0, image.shape[1], image.shape[0])
        heat = RowHeat(np.zeros((64, 96), np.uint8), 0.0)
        told = measure(candidates_in(image, cover, heat, any_camera(None), Vegetation()), cover, heat)
        for each in told:
            assert np.isfinite(each.features()).all()
            assert np.isfinite(each.row_features(0.0)).all()


def test_a_regression_gives_its_log_odds() -> None:
    regression = Regression(mean=(1.0, 0.0), deviation=(2.0, 1.0), weight=(4.0, -1.0), intercept=0.5)

    assert regression.log_odds(np.array([[3.0, 2.0]])) == pytest.approx([4.0 - 2.0 + 0.5])
