"""Perception is fed what is no picture of rows: nothing breaks, and no row is reported."""

from dataclasses import replace
from math import isfinite
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from numpy.typing import NDArray

from fieldnav.messages import RowLine
from fieldnav.perception.lane import comb_m
from fieldnav.perception.perceive import View, find
from fieldnav.perception.plants import find_plants
from fieldnav.perception.tracking import TrackedRows, track
from fieldnav.perception.unposed import find_unposed
from fieldnav.pinhole import Pinhole

Anything = NDArray[np.generic]

REPORTED = 0.5
SMALLEST_PX = 8
SIZE = (720, 1280)


def speckled(shape: tuple[int, ...], top: int = 255) -> Anything:
    return np.random.default_rng(7).integers(0, top, shape, dtype=np.uint16, endpoint=True)


ODD = {
    "black": np.zeros((*SIZE, 3), np.uint8),
    "white": np.full((*SIZE, 3), 255, np.uint8),
    "green": np.full((*SIZE, 3), (40, 160, 60), np.uint8),
    "pure green": np.full((*SIZE, 3), (0, 255, 0), np.uint8),
    "noise": speckled((*SIZE, 3)).astype(np.uint8),
    "dark noise": speckled((*SIZE, 3), 12).astype(np.uint8),
    "grey without channels": speckled(SIZE).astype(np.uint8),
    "grey in three channels": np.repeat(speckled((*SIZE, 1)), 3, axis=2).astype(np.uint8),
    "one channel": speckled((*SIZE, 1)).astype(np.uint8),
    "two channels": speckled((*SIZE, 2)).astype(np.uint8),
    "four channels": speckled((*SIZE, 4)).astype(np.uint8),
    "16 bits": speckled((*SIZE, 3), 65535),
    "floats": speckled((*SIZE, 3)).astype(np.float32) / 255,
    "not a number": np.full((*SIZE, 3), np.nan),
    "infinite": np.full((*SIZE, 3), np.inf),
    "partly not a number": np.where(speckled((*SIZE, 3)) < 128, np.nan, 90.0),
    "truth values": speckled((*SIZE, 3)) < 128,
    "nothing": np.zeros((0, 0, 3), np.uint8),
    "no row of pixels": np.zeros((0, 1280, 3), np.uint8),
    "no column of pixels": np.zeros((720, 0, 3), np.uint8),
    "one pixel": np.full((1, 1, 3), (0, 255, 0), np.uint8),
    "9 by 9": speckled((9, 9, 3)).astype(np.uint8),
    "a slit": speckled((2000, 16, 3)).astype(np.uint8),
    "a strip": speckled((16, 2000, 3)).astype(np.uint8),
    "huge": speckled((3000, 4000, 3)).astype(np.uint8),
}


def camera_for(image: Anything, camera: Pinhole) -> Pinhole:
    """The camera at the picture's size, its view no wider nor taller; unchanged for less than 8 px."""
    height, width = (*image.shape, 1, 1)[:2]
    if min(height, width) < SMALLEST_PX:
        return camera
    focal_px = camera.focal_px * max(width / camera.width_px, height / camera.height_px)
    return replace(camera, width_px=width, height_px=height, focal_px=focal_px)


def reported(image: Anything, drawn: SimpleNamespace) -> list[RowLine]:
    return surely_in(find(image, drawn.beet, camera_for(image, drawn.camera)))


def surely_in(view: View) -> list[RowLine]:
    """The rows that count as reported; none may lie nowhere."""
    rows = view.lines + (view.lane.rows if view.lane else ())
    assert all(isfinite(row.x_top_px) and isfinite(row.x_bottom_px) for row in rows)
    return [row for row in rows if row.confidence >= REPORTED]


def tracked(image: Anything, drawn: SimpleNamespace) -> TrackedRows:
    """The lane straight under the robot, tracked into the picture."""
    camera = camera_for(image, drawn.camera)
    rows = tuple(camera.row_in_image(place, 0.0) for place in comb_m(drawn.beet))
    before = TrackedRows(rows, 0.0)
    centres = find_plants(image, drawn.beet.vegetation, camera)
    return track(before, centres, 0.1, drawn.beet, camera)


@pytest.mark.parametrize("kind", ODD)
def test_what_is_no_picture_of_rows_reports_none(drawn: SimpleNamespace, kind: str) -> None:
    assert reported(ODD[kind], drawn) == []


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("kind", ODD)
def test_nor_does_it_where_the_camera_is_not_known(drawn: SimpleNamespace, kind: str, known: bool) -> None:
    seen = find_unposed(ODD[kind], drawn.beet if known else None)

    assert surely_in(seen.view) == []


@pytest.mark.parametrize("kind", ODD)
def test_tracking_survives_what_is_no_picture_of_rows(drawn: SimpleNamespace, kind: str) -> None:
    after = tracked(ODD[kind], drawn)

    assert len(after.rows) == drawn.beet.rows.per_lane
    assert all(isfinite(row.x_top_px) and isfinite(row.x_bottom_px) for row in after.rows)
    assert all(row.confidence < REPORTED for row in after.rows)


SHAPES = st.tuples(st.integers(0, 90), st.integers(0, 90)) | st.tuples(
    st.integers(0, 90), st.integers(0, 90), st.integers(0, 5)
)
TYPES = st.sampled_from(
    [np.uint8, np.int8, np.uint16, np.int32, np.float16, np.float32, np.float64, np.bool_]
)


@settings(deadline=None, max_examples=150)
@given(st.data())
def test_an_array_of_any_shape_type_and_content_breaks_nothing(
    drawn: SimpleNamespace, data: st.DataObject
) -> None:
    image = data.draw(arrays.arrays(data.draw(TYPES), data.draw(SHAPES)))

    reported(image, drawn)
    tracked(image, drawn)
    surely_in(find_unposed(image, drawn.beet).view)


def noise(seed: int, shape: tuple[int, int], brightest: int) -> NDArray[np.uint8]:
    return np.random.default_rng(seed).integers(0, brightest, (*shape, 3), np.uint8, endpoint=True)


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 2**32), st.integers(1, 255))
def test_noise_of_any_brightness_has_no_row(drawn: SimpleNamespace, seed: int, brightest: int) -> None:
    assert reported(noise(seed, SIZE, brightest), drawn) == []


@pytest.mark.parametrize(("height", "width"), [(48, 64), (240, 320)])
def test_noise_in_a_small_picture_has_no_row(drawn: SimpleNamespace, height: int, width: int) -> None:
    for seed in range(4):
        assert reported(noise(seed, (height, width), 255), drawn) == []


def test_rows_are_still_reported_and_tracked_where_there_are_some(drawn: SimpleNamespace) -> None:
    image = drawn.picture(drawn.beet, drawn.camera, drawn.stand(drawn.beet))

    assert len(reported(image, drawn)) >= drawn.beet.rows.per_lane
    assert all(row.confidence >= REPORTED for row in tracked(image, drawn).rows)
