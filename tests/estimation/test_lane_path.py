"""What the lane's path learns from the plants it passes: where the lane runs, what pushes the robot."""

from math import radians
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import Floats
from fieldnav.odometry import Pose
from fieldnav.perception.lane import comb_m

SEEDS = pytest.mark.parametrize("seed", range(3))
SETTLED_M = 4.0
"""By then the first plants seen lie behind the robot, and the rest is held by what was learnt."""
BEND_PER_M = 1 / 12


def errors_m(walk: SimpleNamespace, distance_m: float) -> Floats:
    """Errors of the offset, estimate less truth, once settled."""
    driven = [(s, walk.error_m()) for s in walk.drive(distance_m)]
    return np.array([error for s, error in driven if s > SETTLED_M])


@SEEDS
def test_a_wrong_first_look_is_forgotten_within_the_view(led: SimpleNamespace, seed: int) -> None:
    walk = led.walk(led.crop, 6.0, seed, wrong=(0.03, -radians(2)))

    began_m = abs(walk.error_m())
    *_, _ = walk.drive(2.5)
    early_m = abs(walk.error_m())

    assert began_m > 0.07
    assert early_m < 0.02
    assert np.abs(errors_m(walk, 3.5)).max() < 0.015
    assert walk.state().heading_rad == pytest.approx(walk.turned_rad, abs=radians(0.5))


@SEEDS
@pytest.mark.parametrize("bend_per_m", [BEND_PER_M, -BEND_PER_M, 0.0])
def test_offset_heading_and_bend_are_those_of_the_lane(
    led: SimpleNamespace, bend_per_m: float, seed: int
) -> None:
    walk = led.walk(led.crop, 8.0, seed, curvature_per_m=bend_per_m)

    assert np.abs(errors_m(walk, 8.0)).max() < 0.015
    assert walk.state().heading_rad == pytest.approx(walk.turned_rad, abs=radians(0.7))
    assert walk.state().curvature_per_m == pytest.approx(bend_per_m, abs=0.015)


@pytest.mark.parametrize("bend_per_m", [BEND_PER_M, 0.0])
def test_a_bend_and_a_turn_that_the_wheels_do_not_report_are_told_apart_in_their_sum(
    led: SimpleNamespace, bend_per_m: float
) -> None:
    walk = led.walk(
        led.crop, 10.0, 0, curvature_per_m=bend_per_m, pushed=led.Pushed(yaw_per_m=0.01), shakes=False
    )

    assert np.abs(errors_m(walk, 10.0)).max() < 0.015
    state = walk.state()
    assert state.curvature_per_m - state.yaw_per_m == pytest.approx(bend_per_m - 0.01, abs=0.004)


def test_a_turn_that_the_wheels_do_not_report_is_learnt_on_a_straight_lane(led: SimpleNamespace) -> None:
    turns = {}
    for yaw_per_m in (0.02, -0.02, 0.0):
        walk = led.walk(led.crop, 12.0, 1, pushed=led.Pushed(yaw_per_m=yaw_per_m))
        assert np.abs(errors_m(walk, 12.0)).max() < 0.025
        turns[yaw_per_m] = walk.state().yaw_per_m

    assert turns[0.02] > 0.008 and turns[-0.02] < -0.008
    assert abs(turns[0.0]) < 0.001


@SEEDS
@pytest.mark.parametrize("sideslip", [0.009, -0.009])
def test_a_side_slope_is_learnt_and_does_not_move_the_robot_off_the_lane(
    led: SimpleNamespace, sideslip: float, seed: int
) -> None:
    walk = led.walk(led.crop, 12.0, seed, pushed=led.Pushed(sideslip=sideslip))

    errors = errors_m(walk, 12.0)

    assert np.abs(errors).max() < 0.015 and abs(errors.mean()) < 0.007
    assert walk.state().sideslip / sideslip == pytest.approx(0.8, abs=0.35)


@SEEDS
def test_uneven_rows_are_learnt_and_the_middle_stays_when_one_of_them_then_vanishes(
    led: SimpleNamespace, seed: int
) -> None:
    uneven_m = 0.1 * led.crop.rows.spacing_m * np.array([1.0, -1.0, 0.0])
    gap_m = (8.0, 13.0)
    walk = led.walk(led.crop, 15.0, seed, shift_m=uneven_m)
    plants = walk.plants_m
    in_gap = (plants[:, 0] > gap_m[0]) & (plants[:, 0] < gap_m[1]) & (plants[:, 1] > 0.2)

    *_, _ = walk.drive(6.0)
    learnt_m = walk.path.place_m - comb_m(led.crop)
    walk.plants_m, walk.weight = plants[~in_gap], walk.weight[~in_gap]
    errors = errors_m(walk, 8.0)

    assert in_gap.sum() > 20
    assert learnt_m == pytest.approx(uneven_m, abs=0.01)
    assert np.abs(errors).max() < 0.015


def test_the_rows_are_told_where_they_stand(led: SimpleNamespace) -> None:
    walk = led.walk(led.crop, 8.0, 0)
    *_, _ = walk.drive(8.0)

    ahead = np.array([1.0, 1.5])
    told = walk.path.rows_at(ahead, walk.reckoned)

    middle = -walk.left_m - np.tan(walk.turned_rad) * ahead
    assert told.shape == (2, led.crop.rows.per_lane)
    assert told == pytest.approx(middle[:, None] + comb_m(led.crop), abs=0.025)
    assert (np.diff(told, axis=1) < 0).all(), "left to right"


def test_plants_are_given_to_their_rows_and_those_between_rows_to_none(led: SimpleNamespace) -> None:
    walk = led.walk(led.crop, 8.0, 0)
    *_, _ = walk.drive(3.0)
    rows_m = walk.path.rows_at(np.array([1.2]), walk.reckoned)[0]
    between_m = (rows_m[:-1] + rows_m[1:]) / 2
    seen = walk.sighting()
    at = np.concatenate([rows_m, between_m])
    points = np.stack([np.full(len(at), 1.2), at], axis=-1)
    far = np.array([[9.0, 0.0], [-9.0, 0.0]])
    reach = np.full(len(at) + len(far), 0.12)
    sighting = type(seen)(np.concatenate([points, far]), reach, np.ones(len(reach)))

    row, off, _ = walk.path.rows_of(sighting)

    assert row.tolist() == [0, 1, 2, -1, -1, -1, -1]
    assert off[:3] == pytest.approx([0.0] * 3, abs=1e-3)
    assert walk.path.see(sighting).tolist() == [1, 1, 1]


def test_between_frames_the_state_goes_by_the_pose_that_the_wheels_report(led: SimpleNamespace) -> None:
    walk = led.walk(led.crop, 4.0, 0)
    *_, _ = walk.drive(4.0)
    here, before = walk.reckoned, walk.state()

    beside = walk.path.state(Pose(here.x_m, here.y_m + 0.02, here.heading_rad + 0.1))

    assert beside.heading_rad == pytest.approx(before.heading_rad + 0.1, abs=0.002)
    assert beside.offset_m == pytest.approx(before.offset_m + 0.02, abs=0.002)
