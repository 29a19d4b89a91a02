"""Vegetation: what counts as a plant, and where it stands."""

from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.perception.plants import find_plants, plants_in
from fieldnav.perception.vegetation import Cover, excess_green, vegetation_of
from fieldnav.settings.crop import Vegetation

SIZE = (720, 1280, 3)


def whole_mask(cover: Cover) -> np.ndarray:
    """The vegetation at the image's own size."""
    size = (cover.width_px, cover.height_px)
    return (
        np.zeros(size[::-1], np.uint8)
        if 0 in size
        else cv2.resize(cover.mask, size, interpolation=cv2.INTER_NEAREST)
    )


def uniform(colour: tuple[int, int, int]) -> np.ndarray:
    return np.full(SIZE, colour, np.uint8)


@given(st.tuples(*[st.integers(40, 255)] * 3))
def test_excess_green_is_that_of_the_formula(colour: tuple[int, int, int]) -> None:
    blue, green, red = colour

    index = excess_green(np.full((2, 2, 3), colour, np.uint8))[0, 0] / 255

    expected = max(0.0, (2 * green - red - blue) / (sum(colour) + 78))
    assert index == pytest.approx(min(expected, 1.0), abs=0.02) or 2 * green - red - blue > 510


@pytest.mark.parametrize(
    "colour", [(72, 96, 122), (0, 0, 0), (255, 255, 255), (128, 128, 128), (90, 100, 96)]
)
def test_a_picture_without_green_has_no_vegetation(
    drawn: SimpleNamespace, colour: tuple[int, int, int]
) -> None:
    grain = np.random.default_rng(1).normal(0, 3, SIZE)
    image = np.clip(uniform(colour) + grain, 0, 255).astype(np.uint8)

    cover = vegetation_of(image, drawn.beet.vegetation)
    centres, mask = plants_in(cover, drawn.beet.vegetation, drawn.camera), whole_mask(cover)

    assert len(centres) == 0
    assert (mask > 0).mean() < 0.01


def test_a_discs_centre_is_found_within_a_pixel(drawn: SimpleNamespace) -> None:
    places = np.array([[300.4, 200.7], [641.2, 352.9], [1001.6, 650.1]])
    image = uniform(drawn.soil)
    for place in places:
        cv2.circle(image, tuple(np.round(place * 16).astype(int).tolist()), 25 * 16, (50, 150, 70), -1, 16, 4)

    cover = vegetation_of(image, drawn.beet.vegetation)
    centres, mask = plants_in(cover, drawn.beet.vegetation, drawn.camera), whole_mask(cover)

    assert centres.position_px == pytest.approx(places, abs=0.5)
    assert centres.area_px == pytest.approx(np.full(3, np.pi * 25**2), rel=0.06)
    assert centres.bottom_px - centres.top_px == pytest.approx(np.full(3, 50), abs=4)
    assert mask.shape == SIZE[:2]
    assert mask[352, 641] and not mask[10, 10]


def test_a_long_bush_is_divided_along_the_row(drawn: SimpleNamespace) -> None:
    image = uniform(drawn.soil)
    cv2.rectangle(image, (600, 0), (680, 719), (50, 150, 70), -1)

    centres = find_plants(image, Vegetation(tallest_region_m=0.2), drawn.camera)

    near_m, far_m = drawn.camera.view_m
    assert (far_m - near_m) / 0.2 <= len(centres) <= (far_m - near_m) / 0.15
    assert centres.position_px[:, 0] == pytest.approx(np.full(len(centres), 640), abs=1)
    assert np.diff(np.sort(centres.position_px[:, 1])) == pytest.approx(720 / len(centres), abs=3)
    assert centres.area_px.sum() == pytest.approx(81 * 720, rel=0.02)


def test_regions_below_the_smallest_area_are_no_plants(drawn: SimpleNamespace) -> None:
    image = drawn.picture(drawn.beet, drawn.camera, np.array([[1.2, 0.0]]), np.array([[1.2, 0.3]]), 0.005)

    centres = find_plants(image, Vegetation(smallest_area_m2=0.0005), drawn.camera)

    assert len(centres) == 1


def test_the_floor_holds_when_otsu_would_split_bare_soil(drawn: SimpleNamespace) -> None:
    image = uniform((100, 104, 100))
    image[:, 640:] = (100, 100, 100)

    assert vegetation_of(image, Vegetation()).mask.sum() == 0


@pytest.mark.parametrize(
    "image",
    [
        np.zeros((720, 1280), np.uint8),
        np.zeros((720, 1280, 1), np.uint8),
        np.zeros((1, 1, 3), np.uint8),
        np.zeros((0, 0, 3), np.uint8),
        np.full((90, 160, 3), np.nan),
        np.full((90, 160, 3), np.inf),
    ],
    ids=["grey", "one channel", "one pixel", "empty", "NaN", "infinite"],
)
def test_what_is_no_picture_holds_no_plants(drawn: SimpleNamespace, image: np.ndarray) -> None:
    cover = vegetation_of(image, Vegetation())
    centres, mask = plants_in(cover, Vegetation(), drawn.camera), whole_mask(cover)

    assert len(centres) == 0
    assert mask.shape == image.shape[:2]


@settings(deadline=None, max_examples=5)
@given(st.integers(0, 2**31 - 1))
def test_a_mirrored_picture_has_the_mirrored_plants(drawn: SimpleNamespace, seed: int) -> None:
    image = drawn.picture(drawn.beet, drawn.camera, drawn.strewn(20, seed), seed=seed)

    plain = find_plants(image, Vegetation(), drawn.camera)
    mirrored = find_plants(np.ascontiguousarray(image[:, ::-1]), Vegetation(), drawn.camera)

    flipped = np.stack([1279 - mirrored.position_px[:, 0], mirrored.position_px[:, 1]], axis=-1)
    order, other = np.lexsort(np.round(plain.position_px, 3).T), np.lexsort(np.round(flipped, 3).T)
    assert plain.position_px[order] == pytest.approx(flipped[other], abs=1e-6)
