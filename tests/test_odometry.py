"""Dead reckoning: poses moved by twists, and the pose at the time of a frame."""

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.messages import Twist
from fieldnav.odometry import Pose, Track


def test_a_quarter_circle_ends_a_radius_ahead_and_a_radius_aside() -> None:
    pose, steps = Pose(), 1000
    for _ in range(steps):
        pose = pose.moved(Twist(1.0, 0.0, pi / 2), 1 / steps)
    assert (pose.x_m, pose.y_m, pose.heading_rad) == pytest.approx((2 / pi, 2 / pi, pi / 2), abs=1e-5)


@given(st.floats(0, 1))
def test_a_frame_is_given_the_pose_between_two_ticks(share: float) -> None:
    track = Track(10)
    track.add(1.0, Pose(0.0, 0.0, 0.0))
    track.add(1.02, Pose(0.01, 0.002, 0.004))
    pose = track.at(1.0 + 0.02 * share)
    expected = (0.01 * share, 0.002 * share, 0.004 * share)
    assert (pose.x_m, pose.y_m, pose.heading_rad) == pytest.approx(expected, abs=1e-9)


def test_a_time_beyond_those_kept_has_the_nearest_pose() -> None:
    track = Track(2)
    for tick in range(5):
        track.add(float(tick), Pose(x_m=float(tick)))
    assert track.at(-1.0).x_m == 3.0
    assert track.at(9.0).x_m == 4.0
