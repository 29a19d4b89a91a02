"""The truth of known rows: heat on their centres, and nothing judged where they melt into one."""

import numpy as np

from fieldnav.training.canvas import HEIGHT_PX, WIDTH_PX
from fieldnav.training.truth import FULL_HEAT, RowCourse, no_rows, truth_of_rows

NOTHING_HIDDEN = np.zeros((HEIGHT_PX, WIDTH_PX), np.float32)
LEVELS_PX = np.arange(-10.0, HEIGHT_PX + 10)


def upright_rows(spacing_px: float) -> list[RowCourse]:
    """Rows straight up through the image, `spacing_px` apart, the first at the left."""
    columns = np.arange(spacing_px / 2, WIDTH_PX, spacing_px)
    ones = np.ones(len(LEVELS_PX))
    return [RowCourse(column * ones, LEVELS_PX, spacing_px * ones) for column in columns]


def test_the_heat_is_highest_on_a_rows_centre() -> None:
    rows = upright_rows(48)

    heat, ignored = truth_of_rows(rows, NOTHING_HIDDEN)

    assert heat[32].argmax() == 12
    assert heat[32, 12] > 0.95 * FULL_HEAT
    assert heat[32, 24] == 0
    assert not ignored.any()


def test_mirrored_rows_have_a_mirrored_heat() -> None:
    ones = np.ones(len(LEVELS_PX))
    slanting = 30 + LEVELS_PX / 3

    heat, _ = truth_of_rows([RowCourse(slanting, LEVELS_PX, 60 * ones)], NOTHING_HIDDEN)
    mirrored, _ = truth_of_rows([RowCourse(WIDTH_PX - 2 - slanting, LEVELS_PX, 60 * ones)], NOTHING_HIDDEN)

    columns = np.arange(heat.shape[1])
    centre = (heat * columns).sum(1) / heat.sum(1)
    other = (mirrored * columns).sum(1) / mirrored.sum(1)
    assert np.abs(centre + other - (heat.shape[1] - 1)).max() < 0.6


def test_rows_closer_than_three_heat_pixels_are_not_judged() -> None:
    heat, ignored = truth_of_rows(upright_rows(5), NOTHING_HIDDEN)

    assert not heat.any()
    assert ignored.all(axis=1).mean() > 0.9


def test_rows_about_four_heat_pixels_apart_are_drawn_but_not_judged() -> None:
    heat, ignored = truth_of_rows(upright_rows(8), NOTHING_HIDDEN)

    assert heat.max() == FULL_HEAT
    assert ignored.mean() > 0.9


def test_what_is_hidden_is_no_row() -> None:
    hidden = NOTHING_HIDDEN.copy()
    hidden[:64] = 1

    heat, _ = truth_of_rows(upright_rows(48), hidden)

    assert not heat[:32].any()
    assert heat[32:].max() > 0.95 * FULL_HEAT


def test_an_image_without_rows_is_judged_everywhere() -> None:
    heat, ignored = no_rows()

    assert not heat.any()
    assert not ignored.any()
