"""The network sees rows where they stand, and none where nothing stands in rows."""

from importlib.resources import files
from itertools import pairwise
from types import SimpleNamespace

import cv2
import numpy as np

from fieldnav.perception.row_network import FULL, SIZE_PX, look

HEAT_SHAPE = (64, 96)


def field(drawn: SimpleNamespace) -> np.ndarray:
    return np.asarray(drawn.picture(drawn.beet, drawn.camera, drawn.stand(drawn.beet, scatter_m=0.01)))


def test_the_heat_is_higher_on_the_rows_than_between_them(drawn: SimpleNamespace) -> None:
    heat = look(field(drawn)).centres / FULL

    assert heat.shape == HEAT_SHAPE
    width, height = drawn.camera.width_px, drawn.camera.height_px
    rows = drawn.rows(drawn.beet, drawn.camera)
    on, between = [], []
    for left, right in pairwise(rows):
        for down in np.linspace(0.2, 0.6, 9):
            first, second = (row.x_top_px + (row.x_bottom_px - row.x_top_px) * down for row in (left, right))
            place = int(down * HEAT_SHAPE[0])
            on.append(heat[place, int(first / width * HEAT_SHAPE[1])])
            between.append(heat[place, int((first + second) / 2 / width * HEAT_SHAPE[1])])
    assert height == 720
    assert np.mean(on) > 0.4
    assert np.mean(between) < 0.1


def test_a_field_is_told_from_what_is_none(drawn: SimpleNamespace) -> None:
    random = np.random.default_rng(3)
    noise = cv2.resize(random.integers(0, 255, (9, 16, 3), dtype=np.uint8), (640, 360))
    grey = np.full((360, 640, 3), 128, np.uint8)

    assert look(field(drawn)).field > 0.8
    assert look(noise).field < 0.3
    assert look(grey).field < 0.3


def test_the_same_picture_is_seen_the_same_twice(drawn: SimpleNamespace) -> None:
    image = field(drawn)

    first, second = look(image), look(image)

    assert np.array_equal(first.centres, second.centres)
    assert first.field == second.field


def test_a_darker_picture_shows_the_same_rows(drawn: SimpleNamespace) -> None:
    image = field(drawn)

    bright, dark = look(image).centres.astype(float), look(image // 2).centres.astype(float)

    assert np.corrcoef(bright.ravel(), dark.ravel())[0, 1] > 0.9


def test_the_network_has_at_most_a_tenth_of_a_million_parameters() -> None:
    content = files("fieldnav.perception").joinpath("row_network.onnx").read_bytes()

    assert len(content) < 100_000 * 4 + 20_000
    assert SIZE_PX == (192, 128)
