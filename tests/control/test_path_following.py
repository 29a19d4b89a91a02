"""The path following law by itself: its symmetries, its bounds, and what it asks for in plain cases."""

from dataclasses import replace
from math import atan, cos, pi, radians, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.control.path_following import follow_path, in_robot_axes
from fieldnav.estimation.lane_state import LaneState
from fieldnav.messages import Motion, Steering, Twist
from fieldnav.settings.crop import Control

CONTROL = Control()
STRAIGHT = CONTROL.model_copy(update={"steering": Steering.DIFFERENTIAL})
BOTH = pytest.mark.parametrize("control", [CONTROL, STRAIGHT], ids=["four wheels", "wheels straight"])
ON_LANE = LaneState(0.0, 0.0, 0.0, 0.01, 0.01, 0.0, 0.0)
SPEEDS = st.floats(0.1, 1.5)
STATES = st.builds(
    LaneState,
    st.floats(-0.5, 0.5),
    st.floats(-0.6, 0.6),
    st.floats(-0.1, 0.1),
    st.just(0.01),
    st.just(0.01),
    st.floats(-0.05, 0.05),
    st.floats(-0.05, 0.05),
)


def mirrored(state: LaneState) -> LaneState:
    return replace(
        state,
        offset_m=-state.offset_m,
        heading_rad=-state.heading_rad,
        curvature_per_m=-state.curvature_per_m,
        sideslip=-state.sideslip,
        yaw_per_m=-state.yaw_per_m,
    )


@BOTH
@given(speed_mps=SPEEDS)
def test_a_robot_on_its_lane_goes_straight_ahead(control: Control, speed_mps: float) -> None:
    assert follow_path(ON_LANE, speed_mps, control) == Motion(Twist(speed_mps), control.steering)


@BOTH
@given(state=STATES, speed_mps=SPEEDS)
def test_mirrored_states_give_the_mirrored_motion(
    control: Control, state: LaneState, speed_mps: float
) -> None:
    twist = follow_path(state, speed_mps, control).twist
    mirror = follow_path(mirrored(state), speed_mps, control).twist

    assert mirror == Twist(twist.vx_mps, -twist.vy_mps, -twist.yaw_rate_rps)


@BOTH
@given(state=STATES, speed_mps=SPEEDS)
def test_twice_the_speed_drives_the_same_path(control: Control, state: LaneState, speed_mps: float) -> None:
    once, twice = (follow_path(state, share * speed_mps, control).twist for share in (1, 2))

    assert twice.vy_mps == pytest.approx(2 * once.vy_mps)
    assert twice.yaw_rate_rps == pytest.approx(2 * once.yaw_rate_rps)


@given(state=STATES, speed_mps=SPEEDS)
def test_the_crab_is_bounded(state: LaneState, speed_mps: float) -> None:
    twist = follow_path(state, speed_mps, CONTROL).twist

    assert abs(atan(twist.vy_mps / twist.vx_mps)) <= CONTROL.steepest_crab_rad + 1e-9
    assert twist.vx_mps == speed_mps


def test_far_off_the_lane_the_crab_is_as_steep_as_it_may_be() -> None:
    twist = follow_path(replace(ON_LANE, offset_m=2.0), 0.5, CONTROL).twist

    assert atan(twist.vy_mps / twist.vx_mps) == pytest.approx(-CONTROL.steepest_crab_rad)


@given(state=STATES, speed_mps=SPEEDS)
def test_wheels_held_straight_are_never_asked_to_go_sideways(state: LaneState, speed_mps: float) -> None:
    motion = follow_path(state, speed_mps, STRAIGHT)

    assert motion.twist.vy_mps == 0.0
    assert motion.steering is Steering.DIFFERENTIAL


@given(st.floats(-radians(14), radians(14)), SPEEDS)
def test_a_robot_that_stands_askew_on_its_lane_crabs_so_as_to_stay_on_it(
    heading_rad: float, speed_mps: float
) -> None:
    twist = follow_path(replace(ON_LANE, heading_rad=heading_rad), speed_mps, CONTROL).twist

    off_lane = twist.vx_mps * sin(heading_rad) + twist.vy_mps * cos(heading_rad)
    assert off_lane == pytest.approx(0.0, abs=0.04 * speed_mps * abs(heading_rad) + 1e-12)
    assert twist.yaw_rate_rps * heading_rad <= 0, "while it turns back"


@pytest.mark.parametrize("radius_m", [12.0, -12.0])
def test_beside_a_bends_path_the_yaw_rate_is_that_of_the_wider_or_the_narrower_circle(
    radius_m: float,
) -> None:
    beside = replace(ON_LANE, offset_m=0.5, curvature_per_m=1 / radius_m)

    turn = follow_path(beside, 1.0, CONTROL).twist.yaw_rate_rps

    assert turn == pytest.approx(1 / (radius_m - 0.5))


def test_far_inside_a_bend_the_yaw_rate_does_not_run_away() -> None:
    at_centre = replace(ON_LANE, offset_m=10.0, curvature_per_m=0.1)

    turn = follow_path(at_centre, 1.0, CONTROL).twist.yaw_rate_rps

    assert turn == pytest.approx(0.2)


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1))
def test_a_robot_that_drives_backward_has_both_velocities_turned_about_and_yaws_the_same(
    vx_mps: float, vy_mps: float, yaw_rate_rps: float
) -> None:
    motion = Motion(Twist(vx_mps, vy_mps, yaw_rate_rps), Steering.OMNIDIRECTIONAL)

    backward = in_robot_axes(motion, -1)

    assert backward == Motion(Twist(-vx_mps, -vy_mps, yaw_rate_rps), Steering.OMNIDIRECTIONAL)
    assert in_robot_axes(motion, 1) == motion


@given(STATES, st.floats(-pi, pi))
def test_backward_the_robot_moves_over_the_ground_as_it_would_turned_about(
    state: LaneState, heading_rad: float
) -> None:
    motion = follow_path(state, 0.5, CONTROL)

    over_ground = [
        (
            twist.vx_mps * cos(heading) - twist.vy_mps * sin(heading),
            twist.vx_mps * sin(heading) + twist.vy_mps * cos(heading),
        )
        for twist, heading in (
            (motion.twist, heading_rad),
            (in_robot_axes(motion, -1).twist, heading_rad + pi),
        )
    ]

    assert over_ground[1] == pytest.approx(over_ground[0], abs=1e-9)
