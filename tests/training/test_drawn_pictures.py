"""Drawn pictures: the truth lies on what was drawn, and every seed has its picture."""

from functools import cache

import cv2
import numpy as np
import pytest

from fieldnav.training.drawn_picture import ROWS_SHARE, DrawnPicture, draw
from fieldnav.training.truth import FULL_HEAT

SEEDS = range(36)  # a tenth of a second each
IMAGE, HEAT = (128, 192, 3), (64, 96)
ROW, BETWEEN = 0.8 * FULL_HEAT, 0.05 * FULL_HEAT


@cache
def picture(seed: int) -> DrawnPicture:
    return draw(seed)


def has_rows(seed: int) -> bool:
    """By the first number drawn of the seed, as the generator decides."""
    return bool(np.random.default_rng(seed).random() < ROWS_SHARE)


def greenness(image: np.ndarray) -> np.ndarray:
    """Excess green at the size of the heat."""
    blue, green, red = cv2.split(
        cv2.resize(image, HEAT[::-1], interpolation=cv2.INTER_AREA).astype(np.float32)
    )
    return np.asarray((2 * green - red - blue) / (red + green + blue + 30))


@pytest.mark.parametrize("seed", [0, 7, 23])
def test_a_seed_always_draws_the_same_picture(seed: int) -> None:
    first, second = picture(seed), draw(seed)

    assert np.array_equal(first.image, second.image)
    assert np.array_equal(first.heat, second.heat)
    assert np.array_equal(first.ignored, second.ignored)


def test_different_seeds_draw_different_pictures() -> None:
    assert len({picture(seed).image.tobytes() for seed in SEEDS}) == len(SEEDS)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_picture_has_its_shapes_and_types(seed: int) -> None:
    drawn = picture(seed)

    assert (drawn.image.shape, drawn.image.dtype) == (IMAGE, np.uint8)
    assert (drawn.heat.shape, drawn.heat.dtype) == (HEAT, np.uint8)
    assert (drawn.ignored.shape, drawn.ignored.dtype) == (HEAT, np.bool_)


@pytest.mark.parametrize("seed", [seed for seed in SEEDS if not has_rows(seed)])
def test_a_picture_without_a_field_has_no_heat_and_is_judged_everywhere(seed: int) -> None:
    drawn = picture(seed)

    assert not drawn.heat.any()
    assert not drawn.ignored.any()


def test_nearly_every_field_shows_rows() -> None:
    fields = [seed for seed in SEEDS if has_rows(seed)]

    shown = [seed for seed in fields if (picture(seed).heat > ROW).any()]

    assert len(shown) >= 0.9 * len(fields), sorted(set(fields) - set(shown))


def test_three_of_five_pictures_show_a_field() -> None:
    share = np.mean([has_rows(seed) for seed in range(2000)])

    assert share == pytest.approx(0.6, abs=0.04)


def test_it_is_greener_on_the_rows_than_between_them() -> None:
    differences = []
    for seed in filter(has_rows, SEEDS):
        drawn = picture(seed)
        on, between = (mask & ~drawn.ignored for mask in (drawn.heat > ROW, drawn.heat < BETWEEN))
        if on.sum() and between.sum():
            green = greenness(drawn.image)
            differences.append(float(green[on].mean() - green[between].mean()))

    assert np.mean(np.array(differences) > 0) > 0.65, differences
    assert np.mean(differences) > 0.02, differences


def test_images_vary_in_brightness_as_outdoors() -> None:
    means = [picture(seed).image.mean() for seed in SEEDS]

    assert min(means) < 80
    assert max(means) > 130
