"""How sure the lane's path is of itself: without sight, standing, among weeds, with lost frames, mirrored."""

from dataclasses import astuple
from math import radians
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.estimation.sighting import Sighting

WEEDS_PER_M2 = 10
"""As many as there are crop plants."""
BLIND_M = 2.0


def blind(frame: int) -> bool:
    return False


def test_without_sight_the_path_stays_close_and_says_how_close(led: SimpleNamespace) -> None:
    seen, unseen = [], []
    for seed in range(30):
        random = np.random.default_rng(seed)
        pushed = led.Pushed(*random.normal(0, 0.008, 2), aside_sd_m=0.005, turn_sd_rad=0.005)
        walk = led.walk(led.crop, 8.0, seed, pushed=pushed)
        *_, _ = walk.drive(4.0)
        seen.append((walk.error_m(), walk.state().offset_sd_m))
        *_, _ = walk.drive(BLIND_M, blind)
        unseen.append((walk.error_m(), walk.state().offset_sd_m))

    error_m, spread_m = np.array(unseen).T
    assert np.abs(error_m).max() < 0.03
    for errors, spreads in (np.array(seen).T, (error_m, spread_m)):
        normalised = np.sqrt(np.mean((errors / spreads) ** 2))
        assert 0.3 < normalised < 1.2, "it neither boasts nor frets"


def test_uncertainty_grows_without_sight_steadily_and_falls_with_it(led: SimpleNamespace) -> None:
    walk = led.walk(led.crop, 14.0, 0)
    *_, _ = walk.drive(4.0)

    grown = np.array([walk.state().offset_sd_m for _ in walk.drive(6.0, blind)])
    *_, _ = walk.drive(3.0)

    assert (np.diff(grown) > 0).all()
    assert grown[39] < 0.04 < led.crop.control.most_uncertain_m, "a bound bridges the longest gap"
    assert grown[-1] > led.crop.control.most_uncertain_m, "and is reached before the robot is lost"
    assert walk.state().offset_sd_m < 0.02


def test_a_robot_that_stands_learns_nothing_new_from_the_same_plants(led: SimpleNamespace) -> None:
    walk = led.walk(led.crop, 6.0, 0)
    *_, _ = walk.drive(2.0)
    before = walk.state()

    for shake in range(50):
        sighting = walk.sighting()
        moved = sighting.position_m + np.array([0.0, 0.03 * (shake % 3)])
        walk.path.carry(walk.reckoned)
        counts = walk.path.see(Sighting(moved, sighting.reach_m, sighting.weight))

    assert walk.state() == before
    assert counts.sum() > 0, "though it still says which rows it sees"


def test_many_looks_at_few_plants_are_few_plants_word(led: SimpleNamespace) -> None:
    spreads = []
    for every in (1, 4):
        walk = led.walk(led.crop, 6.0, 0)
        *_, _ = walk.drive(3.0, lambda frame, every=every: frame % every == 0)
        spreads.append(walk.state().offset_sd_m)

    assert spreads[1] < 1.35 * spreads[0]


@pytest.mark.parametrize("seed", range(4))
def test_weeds_strewn_about_do_not_move_the_path(led: SimpleNamespace, seed: int) -> None:
    clean, weedy = (led.walk(led.crop, 8.0, seed) for _ in range(2))
    random = np.random.default_rng(100 + seed)
    weeds = random.uniform([0, -1.0], [10.0, 1.0], (10 * 2 * WEEDS_PER_M2, 2))
    crop_plants = len(clean.plants_m)
    weedy.plants_m = np.concatenate([weedy.plants_m, weeds])
    weedy.weight = np.concatenate([weedy.weight, random.uniform(0.1, 1.0, len(weeds))])

    pairs = zip(clean.drive(8.0), weedy.drive(8.0), strict=True)
    moved = [weedy.state().offset_m - clean.state().offset_m for s, _ in pairs if s > 2]

    assert len(weeds) > 0.9 * crop_plants
    assert np.abs(moved).max() < 0.015
    assert np.sqrt(np.mean(np.square(moved))) < 0.01


@pytest.mark.parametrize("seed", range(3))
def test_lost_frames_do_not_hurt(led: SimpleNamespace, seed: int) -> None:
    walk = led.walk(led.crop, 8.0, seed)
    random = np.random.default_rng(seed)
    lost = random.random(200) < 0.3
    lost[60:70] = True

    errors = [walk.error_m() for s in walk.drive(8.0, lambda frame: not lost[frame]) if s > 2]

    assert np.abs(errors).max() < 0.015


@pytest.mark.parametrize("aside_deg", [0.3, -0.3])
def test_a_camera_that_looks_aside_does_not_move_the_robots_centre_off_the_lane(
    led: SimpleNamespace, aside_deg: float
) -> None:
    walk = led.walk(led.crop, 12.0, 0, camera_aside_rad=radians(aside_deg))

    errors = [walk.error_m() for s in walk.drive(12.0) if s > 4]

    assert abs(np.mean(errors)) < 0.008
    assert np.abs(errors).max() < 0.015


@settings(max_examples=12, deadline=None)
@given(
    st.integers(0, 10**6),
    st.floats(-0.08, 0.08),
    st.floats(-0.015, 0.015),
    st.floats(-0.02, 0.02),
    st.floats(-0.05, 0.05),
)
def test_mirrored_sightings_give_the_negated_state(
    led: SimpleNamespace, seed: int, bend_per_m: float, sideslip: float, yaw_per_m: float, wrong_m: float
) -> None:
    states = []
    for mirror in (1, -1):
        pushed = led.Pushed(mirror * sideslip, mirror * yaw_per_m)
        walk = led.walk(led.crop, 3.0, seed, bend_per_m, wrong=(wrong_m, 0.01), mirror=mirror, pushed=pushed)
        *_, _ = walk.drive(2.0)
        states.append((astuple(walk.state()), walk.path.place_m))

    (state, places), (mirrored, swapped) = states
    signs = (-1, -1, -1, 1, 1, -1, -1)
    assert mirrored == pytest.approx(
        [sign * value for sign, value in zip(signs, state, strict=True)], abs=1e-7
    )
    assert swapped == pytest.approx(-places[::-1], abs=1e-7)


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 10**6), st.lists(st.booleans(), min_size=80, max_size=80))
def test_the_covariance_stays_symmetric_and_positive(
    led: SimpleNamespace, seed: int, looks: list[bool]
) -> None:
    walk = led.walk(led.crop, 5.0, seed, pushed=led.Pushed(0.01, 0.01))

    before = len(walk.path._covariance)
    for frame, _ in enumerate(walk.drive(4.0, lambda frame: looks[frame])):
        if frame % 8:
            continue
        covariance = walk.path._covariance
        assert covariance == pytest.approx(covariance.T, abs=1e-12)
        assert np.linalg.eigvalsh(covariance).min() > -1e-9 * np.abs(covariance).max()
        assert len(covariance) <= before + 1, "what lies far behind is dropped"
