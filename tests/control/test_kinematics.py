from math import atan2, cos, degrees, hypot, pi, radians, sin

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from fieldnav.control.kinematics import body_twist, wheel_setpoints
from fieldnav.messages import Motion, Steering, Twist, Wheel, WheelSetpoint
from fieldnav.settings.robot import Geometry, Limits

GEOMETRY = Geometry(track_m=1.4, wheelbase_m=1.0, length_m=1.4, clearance_m=0.86)
LIMITS = Limits(speed_mps=1.5)
OMNI = Steering.OMNIDIRECTIONAL
STRAIGHT = dict.fromkeys(Wheel, 0.0)
OTHER_SIDE = {
    Wheel.FRONT_LEFT: Wheel.FRONT_RIGHT,
    Wheel.FRONT_RIGHT: Wheel.FRONT_LEFT,
    Wheel.REAR_LEFT: Wheel.REAR_RIGHT,
    Wheel.REAR_RIGHT: Wheel.REAR_LEFT,
}

twists = st.builds(Twist, st.floats(-0.6, 0.6), st.floats(-0.6, 0.6), st.floats(-0.5, 0.5))
presents = st.fixed_dictionaries({wheel: st.floats(-3, 3) for wheel in Wheel})


def of(twist, steering=OMNI, present=STRAIGHT, hold=False, limits=LIMITS):
    return wheel_setpoints(Motion(twist, steering, hold), GEOMETRY, present, limits)


def as_tuple(twist):
    return twist.vx_mps, twist.vy_mps, twist.yaw_rate_rps


def place_speed(twist, wheel):
    x, y = GEOMETRY.position_m(wheel)
    return hypot(twist.vx_mps - twist.yaw_rate_rps * y, twist.vy_mps + twist.yaw_rate_rps * x)


@given(twists, presents)
def test_wheels_do_the_twist_they_were_given(twist, present):
    assume(all(place_speed(twist, wheel) > 1e-3 for wheel in Wheel))

    assert as_tuple(body_twist(of(twist, present=present), GEOMETRY)) == pytest.approx(
        as_tuple(twist), abs=1e-9
    )


@given(st.floats(-0.8, 0.8), st.floats(-0.3, 0.3))
def test_straight_wheels_do_the_speed_and_the_yaw_rate_they_were_given(vx_mps, yaw_rate_rps):
    twist = Twist(vx_mps, 0.0, yaw_rate_rps)
    setpoints = of(twist, Steering.DIFFERENTIAL)

    assert {setpoint.steering_rad for setpoint in setpoints.values()} == {0.0}
    assert as_tuple(body_twist(setpoints, GEOMETRY)) == pytest.approx(as_tuple(twist), abs=1e-9)


@given(twists, presents)
def test_every_wheel_is_perpendicular_to_its_line_from_the_centre_of_rotation(twist, present):
    assume(abs(twist.yaw_rate_rps) > 1e-3)
    centre = (-twist.vy_mps / twist.yaw_rate_rps, twist.vx_mps / twist.yaw_rate_rps)

    for wheel, setpoint in of(twist, present=present).items():
        if setpoint.speed_mps:
            x, y = GEOMETRY.position_m(wheel)
            line = (x - centre[0], y - centre[1])
            along = cos(setpoint.steering_rad) * line[0] + sin(setpoint.steering_rad) * line[1]
            assert along == pytest.approx(0, abs=1e-6 * max(1, hypot(*line)))


@given(twists, presents, st.sampled_from(Steering))
@example(Twist(-0.5, 0.0, 0.0), STRAIGHT | {Wheel.REAR_LEFT: 3.0}, OMNI)
def test_a_mirrored_twist_gives_mirrored_wheels(twist, present, steering):
    assume(all(place_speed(twist, wheel) > 1e-3 for wheel in Wheel))
    mirrored_present = {OTHER_SIDE[wheel]: -angle for wheel, angle in present.items()}
    mirrored_twist = Twist(twist.vx_mps, -twist.vy_mps, -twist.yaw_rate_rps)

    setpoints = of(twist, steering, present)
    mirrored = of(mirrored_twist, steering, mirrored_present)

    for wheel, setpoint in setpoints.items():
        assert mirrored[OTHER_SIDE[wheel]].speed_mps == pytest.approx(setpoint.speed_mps)
        assert mirrored[OTHER_SIDE[wheel]].steering_rad == pytest.approx(-setpoint.steering_rad)


@given(
    st.builds(Twist, st.floats(-9, 9), st.floats(-9, 9), st.floats(-9, 9)),
    presents,
    st.sampled_from(Steering),
)
def test_no_rim_is_faster_than_the_limit_and_no_angle_past_a_half_turn(twist, present, steering):
    for setpoint in of(twist, steering, present).values():
        assert abs(setpoint.speed_mps) <= LIMITS.speed_mps + 1e-12
        assert abs(setpoint.steering_rad) <= pi


@given(twists, presents)
def test_the_steering_limit_is_kept_where_a_wheel_can_reverse(twist, present):
    setpoints = wheel_setpoints(
        Motion(twist, OMNI), GEOMETRY, present, LIMITS, steering_limit_rad=radians(100)
    )

    for wheel, setpoint in setpoints.items():
        if setpoint.speed_mps:
            assert abs(setpoint.steering_rad) <= radians(100), wheel


def test_slowing_for_the_limit_keeps_the_centre_of_rotation():
    slow, fast = of(Twist(0.3, 0.1, 0.2)), of(Twist(3.0, 1.0, 2.0))

    for wheel in Wheel:
        assert fast[wheel].steering_rad == pytest.approx(slow[wheel].steering_rad)
    assert max(abs(setpoint.speed_mps) for setpoint in fast.values()) == pytest.approx(1.5)


@pytest.mark.parametrize("sideways", [1, -1])
def test_sideways_from_straight_wheels_turns_them_all_to_that_side(sideways):
    for setpoint in of(Twist(0.0, 0.15 * sideways)).values():
        assert setpoint == WheelSetpoint(pytest.approx(0.15), pytest.approx(sideways * pi / 2))


def test_backward_from_straight_wheels_reverses_them_and_turns_nothing():
    for setpoint in of(Twist(-0.5)).values():
        assert setpoint == WheelSetpoint(pytest.approx(-0.5), pytest.approx(0.0))


def test_the_other_way_sideways_reverses_and_turns_nothing():
    present = dict.fromkeys(Wheel, pi / 2)

    for setpoint in of(Twist(0.0, -0.15), present=present).values():
        assert setpoint == WheelSetpoint(pytest.approx(-0.15), pytest.approx(pi / 2))


@pytest.mark.parametrize(("asked_deg", "turned_deg"), [(85, 85), (99, 99), (101, -79), (150, -30), (180, 0)])
def test_past_a_right_angle_and_the_hysteresis_a_wheel_turns_the_other_way_and_reverses(
    asked_deg, turned_deg
):
    twist = Twist(0.3 * cos(radians(asked_deg)), 0.3 * sin(radians(asked_deg)))

    setpoint = of(twist)[Wheel.FRONT_LEFT]

    assert degrees(setpoint.steering_rad) == pytest.approx(turned_deg, abs=1e-6)
    assert setpoint.speed_mps == pytest.approx(0.3 if asked_deg == turned_deg else -0.3)


@given(st.floats(80, 100), st.floats(-3, 3))
def test_a_wheel_under_way_to_a_side_does_not_change_its_mind_for_noise(asked_deg, noise_deg):
    angle_rad = of(Twist(0.3 * cos(radians(asked_deg)), 0.3 * sin(radians(asked_deg))))[
        Wheel.FRONT_LEFT
    ].steering_rad
    on_the_way = dict.fromkeys(Wheel, angle_rad / 10)
    noisy = radians(asked_deg + noise_deg)

    again = of(Twist(0.3 * cos(noisy), 0.3 * sin(noisy)), present=on_the_way)[Wheel.FRONT_LEFT].steering_rad

    assert again * angle_rad > 0


def test_a_wheel_turned_sideways_comes_back_to_straight_when_asked_backward():
    present = dict.fromkeys(Wheel, pi / 2)

    for setpoint in of(Twist(-0.3, 0.03), present=present).values():
        assert setpoint.speed_mps < 0
        assert abs(setpoint.steering_rad) < 0.2


def test_hold_turns_the_wheels_and_drives_none():
    twist = Twist(0.1, 0.15, 0.1)

    for wheel, setpoint in of(twist, hold=True).items():
        assert setpoint.speed_mps == 0
        assert setpoint.steering_rad == of(twist)[wheel].steering_rad


def test_standing_still_keeps_the_present_angles_when_omnidirectional():
    present = {wheel: 0.1 * number for number, wheel in enumerate(Wheel)}

    assert of(Twist(), present=present) == {
        wheel: WheelSetpoint(0.0, angle) for wheel, angle in present.items()
    }
    assert set(of(Twist(), Steering.DIFFERENTIAL, present).values()) == {WheelSetpoint(0.0, 0.0)}


@given(twists)
def test_two_wheels_tell_the_whole_twist_and_one_tells_no_yaw(twist):
    assume(all(place_speed(twist, wheel) > 1e-3 for wheel in Wheel))
    setpoints = of(twist)
    two = {wheel: setpoints[wheel] for wheel in (Wheel.FRONT_LEFT, Wheel.REAR_RIGHT)}

    assert as_tuple(body_twist(two, GEOMETRY)) == pytest.approx(as_tuple(twist), abs=1e-9)
    one = setpoints[Wheel.FRONT_LEFT]
    alone = body_twist({Wheel.FRONT_LEFT: one}, GEOMETRY)
    assert alone.yaw_rate_rps == 0
    assert hypot(alone.vx_mps, alone.vy_mps) == pytest.approx(abs(one.speed_mps))
    assert body_twist({}, GEOMETRY) == Twist()


def test_turning_on_the_spot_goes_round_the_middle():
    for wheel, setpoint in of(Twist(0, 0, 0.5)).items():
        x, y = GEOMETRY.position_m(wheel)
        direction = setpoint.steering_rad + (pi if setpoint.speed_mps < 0 else 0)
        assert abs(setpoint.speed_mps) == pytest.approx(0.5 * hypot(x, y))
        assert sin(direction - atan2(x, -y)) == pytest.approx(0, abs=1e-9)
        assert cos(direction - atan2(x, -y)) == pytest.approx(1)
