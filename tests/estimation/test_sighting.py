"""What a frame's plants say together: outliers are held down, what roll moves alike says little."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.estimation.sighting import SHAKE_M, information

SCATTER_M = 0.03
KNOWN = np.zeros((2, 2))
"""Nothing is uncertain beforehand."""


def told(
    off_m: list[float], design: list[list[float]], weight: float = 1.0, new: float = 1.0
) -> tuple[np.ndarray, np.ndarray]:
    weights = np.full(len(off_m), weight)
    return information(np.array(design), np.array(off_m), weights, KNOWN, SCATTER_M, new)


@given(st.lists(st.tuples(st.floats(-0.2, 0.2), st.floats(-2, 2)), min_size=1, max_size=12))
def test_information_is_symmetric_and_never_negative(plants: list[tuple[float, float]]) -> None:
    matrix, _ = told([off for off, _ in plants], [[1.0, x] for _, x in plants])

    assert matrix == pytest.approx(matrix.T)
    assert np.linalg.eigvalsh(matrix).min() > -1e-6


@given(st.floats(0.001, 0.2))
def test_mirrored_plants_pull_the_other_way(off_m: float) -> None:
    (left, pull), (right, push) = (told([sign * off_m, 0.0], [[1.0, 0.0], [1.0, 1.0]]) for sign in (1, -1))

    assert left == pytest.approx(right)
    assert push == pytest.approx(-pull)


def test_a_plant_far_off_its_row_pulls_no_harder_than_one_at_the_bound() -> None:
    apart = [[1.0, 1.0], [1.0, -1.0]]
    near, at_bound, far, further = (told([off, -off], apart)[1][1] for off in (0.02, 0.06, 0.1, 0.2))

    assert near < at_bound
    assert far == pytest.approx(at_bound, rel=0.1) == further


def test_however_many_plants_a_frame_shows_it_tells_the_offset_no_better_than_roll_lets_it() -> None:
    one, _ = told([0.0], [[1.0, 0.0]])
    many, _ = told([0.0] * 500, [[1.0, 0.0]] * 500)

    assert one[0, 0] == pytest.approx(1 / (SCATTER_M**2 + SHAKE_M**2))
    assert many[0, 0] == pytest.approx(SHAKE_M**-2, rel=0.01)


def test_what_plants_say_against_each_other_roll_does_not_weaken() -> None:
    matrix, pull = told([0.01, -0.01], [[1.0, 1.0], [1.0, -1.0]])

    assert matrix[1, 1] == pytest.approx(2 / SCATTER_M**2)
    assert pull == pytest.approx([0.0, 0.02 / SCATTER_M**2])


def test_parts_of_plants_and_plants_seen_before_say_less() -> None:
    apart = [[1.0, 1.0], [1.0, -1.0]]
    whole, part, again = (
        told([0.01, -0.01], apart, weight, new)[0][1, 1]
        for weight, new in ((1.0, 1.0), (0.25, 1.0), (1.0, 0.1))
    )

    assert part == pytest.approx(0.25 * whole)
    assert again == pytest.approx(0.1 * whole)
    assert told([0.01, -0.01], apart, 1.0, 0.0)[0] == pytest.approx(np.zeros((2, 2)))
