"""How far the wind moves leaves."""

import numpy as np
import pytest

from fieldnav.simulation.rendering.wind import FLUTTER, LARGEST_BEND, Wind, make_wind

PHASES = np.linspace(0, 2 * np.pi, 100, dtype=np.float32)


def farthest_m(wind: Wind, height_m: float) -> float:
    heights = np.full(len(PHASES), height_m, np.float32)
    moved = [wind.displacement(heights, PHASES, time_s) for time_s in np.arange(0, 10, 0.05)]
    return float(np.hypot(*np.moveaxis(np.array(moved)[..., :2], -1, 0)).max())


def test_a_leaf_moves_with_its_height_and_the_square_of_the_wind():
    gentle_m = farthest_m(make_wind(2.0, seed=1), 0.1)
    assert gentle_m == pytest.approx(0.01 * 0.1 * (1 + FLUTTER), rel=0.15)
    assert farthest_m(make_wind(2.0, seed=1), 0.2) == pytest.approx(2 * gentle_m, rel=1e-3)
    assert farthest_m(make_wind(6.0, seed=1), 0.1) == pytest.approx(9 * gentle_m, rel=1e-3)


def test_a_storm_bends_plants_no_farther_than_they_bear_and_still_air_not_at_all():
    assert make_wind(15.0, seed=1).bend == LARGEST_BEND
    assert farthest_m(make_wind(0.0, seed=1), 0.1) == 0
