"""The path following law on a robot that obeys it exactly: errors die away, pushes and bends leave none."""

from dataclasses import replace
from math import atan, cos, exp, radians, sin

import pytest

from fieldnav.control.path_following import follow_path
from fieldnav.estimation.lane_state import LaneState
from fieldnav.messages import Steering, Twist
from fieldnav.settings.crop import Control

CONTROL = Control()
STRAIGHT = CONTROL.model_copy(update={"steering": Steering.DIFFERENTIAL})
BOTH = pytest.mark.parametrize("control", [CONTROL, STRAIGHT], ids=["four wheels", "wheels straight"])
ON_LANE = LaneState(0.0, 0.0, 0.0, 0.01, 0.01, 0.0, 0.0)


def driven(state: LaneState, control: Control, distance_m: float, step_m: float = 0.005) -> LaneState:
    """The robot's state after driving by the law for a distance, pushed and turned as the state says."""
    for _ in range(round(distance_m / step_m)):
        twist = follow_path(state, 1.0, control).twist
        aside = twist.vy_mps + state.sideslip * twist.vx_mps
        sideways = twist.vx_mps * sin(state.heading_rad) + aside * cos(state.heading_rad)
        ahead = twist.vx_mps * cos(state.heading_rad) - aside * sin(state.heading_rad)
        along = ahead / (1 - state.offset_m * state.curvature_per_m)
        turn = twist.yaw_rate_rps + state.yaw_per_m - state.curvature_per_m * along
        state = replace(
            state,
            offset_m=state.offset_m + sideways * step_m,
            heading_rad=state.heading_rad + turn * step_m,
        )
    return state


@BOTH
@pytest.mark.parametrize("radius_m", [12.0, -12.0])
def test_a_robot_on_a_bend_stays_on_it(control: Control, radius_m: float) -> None:
    bend = replace(ON_LANE, curvature_per_m=1 / radius_m)

    twist = follow_path(bend, 0.5, control).twist
    after = driven(bend, control, 10.0)

    assert twist == Twist(0.5, 0.0, pytest.approx(0.5 / radius_m))
    assert (after.offset_m, after.heading_rad) == pytest.approx((0.0, 0.0), abs=1e-4)


@BOTH
@pytest.mark.parametrize(("sideslip", "yaw_per_m"), [(0.02, 0.0), (-0.02, 0.01), (0.0, -0.02)])
def test_what_pushes_and_turns_the_robot_leaves_no_error(
    control: Control, sideslip: float, yaw_per_m: float
) -> None:
    after = driven(replace(ON_LANE, sideslip=sideslip, yaw_per_m=yaw_per_m), control, 8.0)

    assert after.offset_m == pytest.approx(0.0, abs=2e-3)
    leant = -atan(sideslip) if control is STRAIGHT else 0.0
    assert after.heading_rad == pytest.approx(leant, abs=1e-3)


def test_an_offset_dies_away_over_its_length_and_turns_nothing() -> None:
    began = replace(ON_LANE, offset_m=0.1)

    after = driven(began, CONTROL, CONTROL.offset_length_m)

    assert after.offset_m == pytest.approx(0.1 * exp(-1), rel=0.01)
    assert after.heading_rad == 0.0


def test_a_heading_dies_away_over_its_length_and_moves_nothing_aside() -> None:
    began = replace(ON_LANE, heading_rad=0.1)

    after = driven(began, CONTROL, CONTROL.heading_length_m)

    assert after.heading_rad == pytest.approx(0.1 * exp(-1), rel=0.02)
    assert after.offset_m == pytest.approx(0.0, abs=1e-3)


@BOTH
@pytest.mark.parametrize("heading_deg", [-15, 0, 15])
@pytest.mark.parametrize("offset_m", [-0.25, 0.25])
def test_from_either_side_the_robot_comes_in_without_crossing_the_lane_by_much(
    control: Control, offset_m: float, heading_deg: float
) -> None:
    state, most_m = replace(ON_LANE, offset_m=offset_m, heading_rad=radians(heading_deg)), 0.0
    for _ in range(100):
        state = driven(state, control, 0.05)
        most_m = max(most_m, -state.offset_m * offset_m / abs(offset_m))

    assert most_m < (0.001 if control is CONTROL else 0.06)
    assert abs(state.offset_m) < 0.01 and abs(state.heading_rad) < radians(1.5)
