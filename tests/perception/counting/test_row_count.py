"""Rows that pass sideways: the count of a path, and the whole counter on drawn fields."""

from collections.abc import Sequence
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.messages import Image, Side
from fieldnav.perception.counting.row_count import RowCount, count_rows
from fieldnav.perception.counting.row_counter import RowCounter

MARGIN = 0.005
ROWS = np.array([0.1, 0.35, 0.6, 1.2])
"""Unevenly far apart, as over the gap between two lanes."""


def counted(path: Sequence[float], direction: Side | None = Side.RIGHT) -> RowCount:
    return count_rows(np.asarray(path, float), ROWS, MARGIN, direction)


def test_each_row_counts_in_the_first_frame_beyond_it() -> None:
    count = counted([0.0, 0.09, 0.11, 0.3, 0.4, 0.5])

    assert (count.rows_crossed, count.frames) == (2, (2, 4))


def test_a_row_that_goes_back_is_taken_off_with_its_frame() -> None:
    count = counted([0.0, 0.2, 0.4, 0.5, 0.3, 0.2])

    assert (count.rows_crossed, count.frames) == (1, (1,))


def test_a_row_passed_again_counts_in_the_frame_of_the_last_time() -> None:
    count = counted([0.0, 0.2, 0.4, 0.2, 0.2, 0.4])

    assert (count.rows_crossed, count.frames) == (2, (1, 5))


def test_moving_against_the_direction_counts_down() -> None:
    count = counted([0.5, 0.3, 0.0])

    assert (count.rows_crossed, count.frames) == (-2, (1, 2))


def test_without_a_direction_the_count_is_that_of_the_way_moved() -> None:
    there, back = counted([0.0, 0.5], None), counted([0.5, 0.0], None)

    assert (there.rows_crossed, there.direction) == (2, Side.RIGHT)
    assert (back.rows_crossed, back.direction) == (2, Side.LEFT)


def test_a_row_that_trembles_at_the_middle_passes_once() -> None:
    trembling = 0.1 + MARGIN / 2 * np.array([-1, 1] * 20)

    count = counted([0.0, *trembling, 0.2])

    assert len(count.passages) == 1 and count.frames == (40,)


def test_a_row_within_the_margin_at_first_belongs_to_the_side_it_leaves_for() -> None:
    assert counted([0.1 - MARGIN / 2, 0.15]).passages == ()


def test_a_row_that_stands_exactly_in_the_middle_has_not_passed() -> None:
    assert counted([0.0, 0.1, 0.1, 0.2]).frames == (3,)


def test_nothing_moves_nothing_counts() -> None:
    assert counted([]).rows_crossed == counted([0.2] * 9).rows_crossed == 0


paths = st.lists(
    st.floats(0.0, 1.5).filter(lambda place: np.abs(ROWS - place).min() > 2 * MARGIN), min_size=1, max_size=60
)


@given(paths)
def test_the_count_is_the_rows_between_the_first_place_and_the_last(path: list[float]) -> None:
    left_of = [(path[-1] > ROWS).sum(), (path[0] > ROWS).sum()]

    count = counted(path)

    assert count.rows_crossed == left_of[0] - left_of[1]
    assert len(count.frames) == abs(count.rows_crossed)
    assert list(count.frames) == sorted(count.frames)


@given(paths)
def test_a_mirrored_path_counts_the_same_the_other_way(path: list[float]) -> None:
    plain = counted(path)

    mirrored = count_rows(-np.asarray(path), -ROWS[::-1], MARGIN, Side.RIGHT)

    assert mirrored.rows_crossed == -plain.rows_crossed
    assert mirrored.frames == plain.frames


@given(paths, st.data())
def test_stops_change_no_count(path: list[float], data: st.DataObject) -> None:
    held = [place for place in path for _ in range(data.draw(st.integers(1, 3)))]

    assert counted(held).rows_crossed == counted(path).rows_crossed


@given(paths)
def test_going_all_the_way_back_leaves_nothing_counted(path: list[float]) -> None:
    count = counted([*path, *path[::-1]])

    assert count.rows_crossed == 0 and count.frames == ()


STEP_M = 0.04
PLACES_M = np.arange(-0.2, 1.45, STEP_M)
"""Right of the first lane's middle row."""
TRUE_M = np.array([0.0, 0.35, 1.15])
"""The rows crossed; the third stands beyond the gap between the lanes."""


@pytest.fixture(scope="module")
def pictures(drawn: SimpleNamespace) -> list[Image]:
    """A robot steps to the right over two lanes, of three rows each, with 0.8 m between them; wide plants."""
    camera, plants = drawn.pinhole(width_px=640), drawn.stand(drawn.beet, scatter_m=0.01)
    lanes = np.concatenate([plants, drawn.stand(drawn.beet, offset_m=-1.5, scatter_m=0.01, seed=2)])
    return [drawn.picture(drawn.beet, camera, lanes + np.array([0.0, place])) for place in PLACES_M]


def shown(pictures: list[Image], frames: Sequence[int], *known: object) -> RowCounter:
    counter = RowCounter(*(known or (None, None)))  # type: ignore[arg-type]
    for frame in frames:
        counter.add(pictures[frame])
    return counter


def assert_true(count: RowCount, frames: Sequence[int]) -> None:
    """The net count is exact and each crossing within a frame of where the drawn row passes."""
    place = PLACES_M[np.asarray(frames)]
    truth = count_rows(place, TRUE_M, 0.0, count.direction)
    assert count.rows_crossed == truth.rows_crossed
    assert count.frames == pytest.approx(truth.frames, abs=1)


EVERY = range(len(PLACES_M))
SHOWN = {
    "forwards": [*EVERY],
    "backwards": [*EVERY][::-1],
    "every second frame": [*EVERY][::2],
    "every third frame": [*EVERY][::3],
    "a stop": [*EVERY[:6]] + [6] * 10 + [*EVERY[6:]],
    "backing up over a row": [*EVERY[:20], *EVERY[18:7:-1], *EVERY[9:]],
    "jitter at the middle": [*EVERY[:5], *[4, 5, 6, 5] * 6, *EVERY[5:]],
    "there and back": [*EVERY, *EVERY[::-1]],
    "begun late": [*EVERY[10:]],
}


@pytest.mark.parametrize("frames", SHOWN.values(), ids=SHOWN)
def test_rows_are_counted_exactly_with_nothing_known(pictures: list[Image], frames: list[int]) -> None:
    assert_true(shown(pictures, frames).result(Side.RIGHT), frames)


def test_rows_are_counted_exactly_with_crop_and_camera_known(
    pictures: list[Image], drawn: SimpleNamespace
) -> None:
    counter = shown(pictures, EVERY, drawn.beet, drawn.pinhole(width_px=640))

    assert_true(counter.result(Side.RIGHT), EVERY)


def test_mirrored_pictures_count_the_same_the_other_way(pictures: list[Image]) -> None:
    mirrored = [np.ascontiguousarray(picture[:, ::-1]) for picture in pictures]

    plain, flipped = (shown(each, EVERY).result(Side.RIGHT) for each in (pictures, mirrored))

    assert flipped.rows_crossed == -plain.rows_crossed == -len(TRUE_M)
    assert flipped.frames == pytest.approx(plain.frames, abs=1)


def test_frames_that_show_nothing_are_bridged_and_named(pictures: list[Image]) -> None:
    dark = [*pictures[:4], *[np.zeros_like(pictures[0])] * 3, *pictures[7:]]

    counter = shown(dark, EVERY)

    assert counter.unplaced == (4, 5, 6)
    assert_true(counter.result(Side.RIGHT), EVERY)


def test_a_robot_that_stands_counts_nothing(pictures: list[Image]) -> None:
    assert shown(pictures, [5] * 20).result(None).passages == ()


@pytest.mark.parametrize("level", [0, 90, 255])
def test_pictures_without_plants_count_nothing(level: int) -> None:
    blank = [np.full((48, 64, 3), level, np.uint8)] * 3

    assert shown(blank, range(3)).result(None).rows_crossed == 0
