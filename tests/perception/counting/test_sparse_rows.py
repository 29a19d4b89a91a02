"""Rows of few plants, on ground that is not clean, counted; weeds on the same ground not counted."""

from collections.abc import Iterable, Sequence

import cv2
import numpy as np
import pytest

from fieldnav.messages import Image, Side
from fieldnav.perception.counting.levelled import PLACES, Levelled
from fieldnav.perception.counting.row_count import RowCount
from fieldnav.perception.counting.row_counter import RowCounter
from fieldnav.perception.counting.sideways_shift import shift_between

WIDTH_PX, HEIGHT_PX, STRIP_PX = 320, 240, 700
MARGIN_PX = 12
"""Of ground above and below the pictures, for a camera that moves up and down."""
SOIL_BGR, HAZE_BGR, LEAF_BGR = (72, 96, 122), (80, 106, 122), (50, 150, 70)
HAZE_PX = 8
"""Blocks in which compression gives bare soil a greenish colour."""
ROWS_PX = (105, 255, 405, 555)
SPACING_PX = 150
SPARSE_PX = ROWS_PX[2]

Plants = Iterable[tuple[float, float, int]]
"""Each plant's place across and along the strip and its radius, in pixels."""

STEPS_PX = {
    "even": [*range(70, 300, 15)],
    "long": [*range(70, 300, 30)],
    "uneven": (60 + np.cumsum(np.random.default_rng(2).integers(4, 26, 16))).tolist(),
}


def full_row(x_px: float, seed: int = 0) -> Plants:
    rng = np.random.default_rng(seed + int(x_px))
    return [(x_px + rng.integers(-2, 3), y, int(rng.integers(6, 10))) for y in range(10, 270, 16)]


def sparse_row(along_px: Sequence[float], radius_px: int = 6) -> Plants:
    return [(SPARSE_PX + 2 * (-1) ** n, y + MARGIN_PX, radius_px) for n, y in enumerate(along_px)]


def strip(plants: Plants, haze: float = 0.0) -> Image:
    """A strip of ground seen from above; haze: share of its blocks that look a little green."""
    rng = np.random.default_rng(7)
    height = HEIGHT_PX + 2 * MARGIN_PX
    blocks = rng.random((height // HAZE_PX + 1, STRIP_PX // HAZE_PX + 1)) < haze
    hazy = np.kron(blocks, np.ones((HAZE_PX, HAZE_PX), bool))[:height, :STRIP_PX, None]
    ground = np.where(hazy, np.array(HAZE_BGR), np.array(SOIL_BGR)).astype(np.uint8)
    for x, y, radius in plants:
        cv2.circle(ground, (round(x), round(y)), radius, LEAF_BGR, cv2.FILLED)
    noisy = ground + rng.normal(0, 2, ground.shape)
    return np.asarray(noisy.clip(0, 255), np.uint8)


def count(ground: Image, places_px: Sequence[int], bob_px: int = 0, side: Side = Side.RIGHT) -> RowCount:
    """What is counted while the camera moves to the right; bob_px: up and down meanwhile."""
    counter = RowCounter(None, None)
    for number, place in enumerate(places_px):
        y = MARGIN_PX + round(bob_px * np.sin(number))
        counter.add(np.ascontiguousarray(ground[y : y + HEIGHT_PX, place : place + WIDTH_PX]))
    return counter.result(side)


def crossings(rows_px: Sequence[int], places_px: Sequence[int]) -> tuple[int, ...]:
    return tuple(int(np.argmax(np.asarray(places_px) > x - (WIDTH_PX - 1) / 2)) for x in rows_px)


FEW = {"four plants": (30, 85, 150, 215), "three plants": (30, 115, 205)}


def field_with(sparse: Plants) -> list[tuple[float, float, int]]:
    return [*full_row(ROWS_PX[0]), *full_row(ROWS_PX[1]), *sparse, *full_row(ROWS_PX[3])]


@pytest.mark.parametrize("haze", [0.0, 0.5], ids=["clean soil", "hazy soil"])
@pytest.mark.parametrize("places", STEPS_PX.values(), ids=STEPS_PX)
@pytest.mark.parametrize("along", FEW.values(), ids=FEW)
def test_a_row_of_few_plants_in_line_counts(along: Sequence[float], places: list[int], haze: float) -> None:
    counted = count(strip(field_with(sparse_row(along)), haze), places)

    expected = crossings(ROWS_PX[1:3], places)
    assert counted.frames == pytest.approx(expected, abs=1)


@pytest.mark.parametrize("bob_px", [4, 10])
def test_a_camera_that_moves_up_and_down_counts_a_sparse_row_too(bob_px: int) -> None:
    counted = count(strip(field_with(sparse_row(FEW["four plants"])), 0.5), STEPS_PX["even"], bob_px)

    assert counted.rows_crossed == 2


def test_a_sparse_row_counts_the_other_way_too() -> None:
    counted = count(strip(field_with(sparse_row(FEW["four plants"])), 0.5), STEPS_PX["even"][::-1])

    assert counted.rows_crossed == -2


def test_a_row_with_a_long_gap_counts_where_a_row_belongs() -> None:
    rest = [(SPARSE_PX, y, 9) for y in range(90, 170, 12)]

    assert count(strip(field_with(rest)), STEPS_PX["even"]).rows_crossed == 2


def test_a_tuft_between_the_rows_is_no_row() -> None:
    tuft = [(SPARSE_PX + SPACING_PX / 2, y, 9) for y in range(90, 170, 12)]

    counted = count(strip(field_with([*full_row(SPARSE_PX), *tuft])), STEPS_PX["even"])

    assert counted.frames == pytest.approx(crossings(ROWS_PX[1:3], STEPS_PX["even"]), abs=1)


def test_hazy_soil_without_plants_has_no_row() -> None:
    assert count(strip([], 0.5), STEPS_PX["even"]).passages == ()


@pytest.mark.parametrize("radius_px", [8, 16, 30])
def test_a_single_tuft_is_no_row(radius_px: int) -> None:
    assert count(strip([(350, 130, radius_px)], 0.2), STEPS_PX["even"]).passages == ()


@pytest.mark.parametrize("seed", range(4))
def test_weeds_strewn_about_are_no_row(seed: int) -> None:
    rng = np.random.default_rng(seed)
    weeds = [(rng.uniform(0, 700), rng.uniform(0, 264), int(rng.integers(2, 6))) for _ in range(20)]

    assert count(strip(weeds, 0.2), STEPS_PX["even"]).passages == ()


def test_plants_that_stand_out_of_line_are_no_sparse_row() -> None:
    plants = [(SPARSE_PX + off, y, 6) for off, y in ((-40, 40), (35, 110), (-30, 180), (45, 240))]

    counted = count(strip(field_with(plants)), STEPS_PX["even"])

    assert counted.frames == pytest.approx(crossings(ROWS_PX[1:2], STEPS_PX["even"]), abs=1)


SPACING = 0.3


def levelled(*rows: tuple[float, float]) -> Levelled:
    """Rows, each with its place in widths and its strength, over the whole height."""
    across = sum(strength * np.exp(-(((PLACES - place) / 0.02) ** 2) / 2) for place, strength in rows)
    seen = np.tile(np.abs(PLACES) < 1 / 2, (48, 1)).astype(np.float32)
    return Levelled(np.asarray(across * seen, np.float32), seen)


def test_a_picture_more_like_another_a_whole_row_away_does_not_make_the_robot_leap() -> None:
    before, after = levelled((0.0, 1.0)), levelled((-0.02, 0.6), (SPACING, 1.0))

    shift = shift_between(before, after, 0.0, SPACING)

    assert shift.widths == pytest.approx(0.02, abs=0.01)
