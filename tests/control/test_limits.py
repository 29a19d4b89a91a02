from math import hypot

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.control.limits import limit
from fieldnav.messages import STANDSTILL, Motion, Steering, Twist
from fieldnav.settings.robot import Limits

LIMITS = Limits(speed_mps=1.0, acceleration_mps2=0.8, yaw_rate_rps=0.5, yaw_acceleration_rps2=1.5)
DT_S = 0.02
DIFFERENTIAL, OMNI = Steering.DIFFERENTIAL, Steering.OMNIDIRECTIONAL

any_twist = st.builds(Twist, st.floats(-9, 9), st.floats(-9, 9), st.floats(-9, 9))
allowed_twist = st.builds(Twist, st.floats(-0.7, 0.7), st.floats(-0.7, 0.7), st.floats(-0.5, 0.5))
any_steering = st.sampled_from(Steering)


def speed(twist):
    return hypot(twist.vx_mps, twist.vy_mps)


@given(any_twist, allowed_twist, st.floats(0, 0.1), any_steering)
def test_no_limit_is_ever_exceeded(wanted, previous, dt_s, steering):
    twist = limit(Motion(wanted, steering), previous, dt_s, LIMITS).twist

    assert speed(twist) <= LIMITS.speed_mps + 1e-9
    assert abs(twist.yaw_rate_rps) <= LIMITS.yaw_rate_rps + 1e-9
    change_mps = hypot(twist.vx_mps - previous.vx_mps, twist.vy_mps - previous.vy_mps)
    assert change_mps <= LIMITS.acceleration_mps2 * dt_s + 1e-9
    assert abs(twist.yaw_rate_rps - previous.yaw_rate_rps) <= LIMITS.yaw_acceleration_rps2 * dt_s + 1e-9


@given(allowed_twist, allowed_twist, any_steering)
def test_what_is_wanted_is_reached_exactly_in_the_end(wanted, previous, steering):
    twist = previous
    for _ in range(200):
        twist = limit(Motion(wanted, steering), twist, DT_S, LIMITS).twist

    assert twist == wanted


@given(any_twist, allowed_twist, any_steering)
def test_a_mirrored_wish_is_limited_to_the_mirrored_twist(wanted, previous, steering):
    def mirror(twist):
        return Twist(twist.vx_mps, -twist.vy_mps, -twist.yaw_rate_rps)

    plain = limit(Motion(wanted, steering), previous, DT_S, LIMITS).twist

    assert limit(Motion(mirror(wanted), steering), mirror(previous), DT_S, LIMITS).twist == mirror(plain)


def test_half_a_metre_a_second_is_reached_and_left_in_the_same_time():
    def ticks(start, goal):
        twist, count = start, 0
        while twist != goal:
            twist = limit(Motion(goal), twist, DT_S, LIMITS).twist
            count += 1
        return count

    cruise = Twist(0.5)

    assert ticks(STANDSTILL, cruise) == pytest.approx(0.5 / 0.8 / DT_S, abs=1)
    assert ticks(cruise, STANDSTILL) <= ticks(STANDSTILL, cruise)


@given(allowed_twist)
def test_a_stop_keeps_the_centre_of_rotation(previous):
    twist = limit(Motion(STANDSTILL), previous, DT_S, LIMITS).twist

    assert twist.vx_mps * previous.yaw_rate_rps == pytest.approx(
        previous.vx_mps * twist.yaw_rate_rps, abs=1e-9
    )
    assert twist.vy_mps * previous.vx_mps == pytest.approx(previous.vy_mps * twist.vx_mps, abs=1e-9)


@given(allowed_twist)
def test_an_omnidirectional_start_keeps_the_centre_of_rotation(wanted):
    twist = limit(Motion(wanted, OMNI), STANDSTILL, DT_S, LIMITS).twist

    assert twist.vx_mps * wanted.yaw_rate_rps == pytest.approx(wanted.vx_mps * twist.yaw_rate_rps, abs=1e-9)


def test_within_the_rows_the_yaw_rate_does_not_wait_for_the_speed():
    twist = limit(Motion(Twist(0.5, 0.0, 0.02), DIFFERENTIAL), STANDSTILL, DT_S, LIMITS).twist

    assert twist.yaw_rate_rps == 0.02
    assert twist.vx_mps == pytest.approx(0.016)


def test_hold_waits_until_the_robot_stands_and_then_tells_its_direction():
    wanted = Motion(Twist(0.0, 0.15), OMNI, hold=True)

    moving = limit(wanted, Twist(0.5), DT_S, LIMITS)
    standing = limit(wanted, STANDSTILL, DT_S, LIMITS)

    assert moving == Motion(Twist(pytest.approx(0.484)), OMNI)
    assert standing == wanted
