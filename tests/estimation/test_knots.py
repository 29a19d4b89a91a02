"""Knots along the middle of a lane: places beside them, the curve through them, more and fewer of them."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.estimation.knots import STEP_M, Knots, straight
from fieldnav.messages import Floats
from fieldnav.odometry import Pose

TIGHTEST_M = 12.0
"""Radius of the tightest bend that fields have."""
POSES = st.builds(Pose, st.floats(-50, 50), st.floats(-50, 50), st.floats(-pi, pi))


def on_circle(radius_m: float, count: int = 16, pose: Pose | None = None) -> Knots:
    """Knots on a circle to the left of a pose, the middle one where the pose is; a radius < 0 bends right."""
    angle = (np.arange(count) - count // 2) * STEP_M / radius_m
    normal = np.stack([-np.sin(angle), np.cos(angle)], axis=-1)
    place = np.array([0.0, radius_m]) - radius_m * normal
    return turned(Knots(place, normal), pose or Pose())


def turned(knots: Knots, pose: Pose) -> Knots:
    """The same knots seen from a pose as they were from the origin."""
    c, s = cos(pose.heading_rad), sin(pose.heading_rad)
    axes = np.array([[c, s], [-s, c]])
    return Knots(knots.place_m @ axes + [pose.x_m, pose.y_m], knots.normal @ axes)


def off_circle(place: Floats, radius_m: float) -> float:
    return float(np.hypot(place[0], place[1] - radius_m) - abs(radius_m))


@pytest.mark.parametrize("radius_m", [TIGHTEST_M, -TIGHTEST_M, 30.0])
def test_a_knot_more_lies_on_the_bend_within_a_millimetre(radius_m: float) -> None:
    knots = on_circle(radius_m, count=4)

    longer = knots.extended()

    assert len(longer) == len(knots) + 1
    assert abs(off_circle(longer.place_m[-1], radius_m)) < 1e-3
    assert np.hypot(*(longer.place_m[-1] - longer.place_m[-2])) == pytest.approx(STEP_M)
    towards = (np.array([0.0, radius_m]) - longer.place_m[-1]) / radius_m
    assert longer.normal[-1] @ towards == pytest.approx(1.0, abs=1e-3), "the normal points to the left"


def test_a_straight_line_goes_on_straight() -> None:
    knots = straight(Pose(), 0.1, 0.2, 0.0, 1.0)
    for _ in range(20):
        knots = knots.extended()

    x, y = knots.place_m.T

    assert y == pytest.approx(0.1 + 0.2 * x)
    assert x[-1] > 5


@given(POSES)
def test_straight_knots_lie_where_they_are_asked_for_in_any_frame(pose: Pose) -> None:
    knots = straight(pose, 0.12, -0.3, -2.0, 1.7)

    x, y = knots.seen_from(pose).T

    assert y == pytest.approx(0.12 - 0.3 * x, abs=1e-9)
    assert x[0] == pytest.approx(-2.0) and 1.7 <= x[-1] < 1.7 + 2 * STEP_M
    left = knots.moved(np.ones(len(knots))).seen_from(pose)
    assert (left[:, 1] > y).all(), "normals point to the left"


def test_knots_move_along_their_normals_alone() -> None:
    knots = on_circle(TIGHTEST_M)

    moved = knots.moved(np.full(len(knots), 0.05))

    assert [off_circle(place, TIGHTEST_M) for place in moved.place_m] == pytest.approx([-0.05] * len(knots))


def test_the_first_knots_are_dropped() -> None:
    knots = on_circle(TIGHTEST_M)

    fewer = knots.dropped(3)

    assert len(fewer) == len(knots) - 3
    assert (fewer.place_m == knots.place_m[3:]).all() and (fewer.normal == knots.normal[3:]).all()


@given(POSES, st.floats(-0.9, 0.9), st.floats(-1.5, 1.5), st.floats(-0.2, 0.2))
def test_a_point_lies_as_far_beside_a_line_as_geometry_says(
    pose: Pose, slope: float, along: float, off: float
) -> None:
    knots = straight(pose, 0.05, slope, -2.0, 2.0)
    steep = hypot(1, slope)
    point = np.array([[along - off * slope / steep, 0.05 + slope * along + off / steep]])

    beside, parts = knots.beside(point, pose)

    assert beside[0] == pytest.approx(off, abs=1e-9)
    assert parts.sum() == pytest.approx(1.0)


def test_between_two_knots_both_take_part_by_how_near_they_are() -> None:
    knots = straight(Pose(), 0.0, 0.0, 0.0, 1.0)
    points = np.array([[0.25 * STEP_M, 0.1], [2 * STEP_M, -0.1]])

    beside, parts = knots.beside(points, Pose())

    assert beside == pytest.approx([0.1, -0.1])
    assert parts[0, :3] == pytest.approx([0.75, 0.25, 0.0])
    assert parts[1, 2] == pytest.approx(1.0)


def test_moving_the_knots_moves_a_point_beside_them_by_its_parts() -> None:
    knots, point = on_circle(TIGHTEST_M), np.array([[0.3, 0.1]])
    before, parts = knots.beside(point, Pose())
    c_m = 0.001 * np.arange(len(knots))

    after, _ = knots.moved(c_m).beside(point, Pose())

    assert after - before == pytest.approx(-parts @ c_m, rel=0.01)


@given(st.sampled_from([12.0, -12.0, 40.0, -40.0]), POSES, st.floats(-0.2, 0.2), st.floats(-0.3, 0.3))
def test_offset_slope_and_curvature_of_a_circle_are_recovered(
    radius_m: float, pose: Pose, aside_m: float, turn_rad: float
) -> None:
    robot = Pose(0.0, aside_m, turn_rad)
    knots = on_circle(radius_m, count=18)
    relative = turned(Knots(knots.seen_from(robot), knots.normal), pose)

    (middle, slope, bend), parts = relative.curve_at(pose)

    # Where the circle crosses the robot's y axis: a small angle from the nearest place.
    assert middle == pytest.approx(-aside_m / cos(turn_rad), abs=4e-3)
    assert slope == pytest.approx(-np.tan(turn_rad), abs=0.03)
    assert bend / hypot(1, slope) ** 3 == pytest.approx(1 / radius_m, rel=0.06)
    assert parts.shape == (3, len(knots))


def test_at_either_end_of_what_is_known_the_nearest_knots_tell() -> None:
    knots = on_circle(TIGHTEST_M, count=8)

    (_, _, bend), parts = knots.curve_at(Pose(-1.6))

    assert bend == pytest.approx(1 / TIGHTEST_M, rel=0.1)
    assert np.count_nonzero(np.abs(parts).sum(axis=0)) == 4
