"""The simulated robot moves as its wheels and the ground make it."""

from collections.abc import Callable
from math import pi, radians, sin, tan
from typing import Any

import numpy as np
import pytest

from drivers.simulated_motion import ModuleErrors
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.settings.loading import load_field
from fieldnav.simulation.body import SCRUB
from fieldnav.simulation.world import CORNERING_STIFFNESS, module_errors

SPEED_MPS, SIDEWAYS_MPS = 0.5, 0.15
TURNED_S = 4.0
"""By then the wheels stand across."""

Make = Callable[..., Any]
Setpoints = dict[Wheel, WheelSetpoint]
AHEAD: Setpoints = {wheel: WheelSetpoint(SPEED_MPS, 0.0) for wheel in Wheel}
ACROSS: Setpoints = {wheel: WheelSetpoint(SIDEWAYS_MPS, pi / 2) for wheel in Wheel}
TURNING: Setpoints = {wheel: WheelSetpoint(0.0, pi / 2) for wheel in Wheel}
OPPOSITE = {
    Wheel.FRONT_LEFT: Wheel.FRONT_RIGHT,
    Wheel.FRONT_RIGHT: Wheel.FRONT_LEFT,
    Wheel.REAR_LEFT: Wheel.REAR_RIGHT,
    Wheel.REAR_RIGHT: Wheel.REAR_LEFT,
}
FRONT, REAR = (Wheel.FRONT_LEFT, Wheel.FRONT_RIGHT), (Wheel.REAR_LEFT, Wheel.REAR_RIGHT)
RIGHT = (Wheel.FRONT_RIGHT, Wheel.REAR_RIGHT)


def test_without_faults_the_robot_drives_straight_ahead(driven: Make) -> None:
    run = driven()
    start = run.world.now.pose

    run.go(AHEAD, 4.0)

    end = run.world.now.pose
    assert end.x_m - start.x_m == pytest.approx(4 * SPEED_MPS, abs=0.2)
    assert end.y_m == pytest.approx(start.y_m, abs=1e-6)
    assert end.heading_rad == pytest.approx(start.heading_rad, abs=1e-6)


@pytest.mark.parametrize("slope_deg", [-5.0, 2.0, 8.0])
def test_a_side_slope_drifts_the_robot_downhill_by_the_slip_angle(slope_deg: float, driven: Make) -> None:
    run = driven(ground={"side_slope_deg": slope_deg})
    start = run.world.now.pose

    run.go(AHEAD, 4.0)

    end = run.world.now.pose
    slip_angle = sin(radians(slope_deg)) / CORNERING_STIFFNESS
    assert end.y_m - start.y_m == pytest.approx(-slip_angle * (end.x_m - start.x_m), rel=0.05)
    assert end.heading_rad == pytest.approx(start.heading_rad, abs=1e-6)


def test_slip_costs_way(driven: Make) -> None:
    firm, soft = driven(), driven(ground={"slip": 0.2})

    ways = []
    for run in (firm, soft):
        start = run.world.now.pose.x_m
        run.go(AHEAD, 3.0)
        ways.append(run.world.now.pose.x_m - start)

    assert ways[1] == pytest.approx(0.8 * ways[0], rel=1e-3)


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_unequal_wheel_speeds_turn_the_robot_to_the_slower_side(seed: int, driven: Make) -> None:
    run = driven(seed=seed, wheel_errors={"speed_error": 0.1})
    factors = {
        wheel: each.speed_factor for wheel, each in module_errors(run.field.wheel_errors, seed, False).items()
    }
    geometry = run.robot.geometry
    before = run.world.now.pose.heading_rad

    run.go(AHEAD, 3.0)

    turned = run.world.now.pose.heading_rad - before
    faster_right = (
        sum(factors[wheel] * (-1 if geometry.position_m(wheel)[1] > 0 else 1) for wheel in Wheel) / 2
    )
    assert np.sign(turned) == np.sign(faster_right)
    free_rad = faster_right / geometry.track_m * 3.0 * SPEED_MPS
    assert 0.4 * abs(free_rad) < abs(turned) < abs(free_rad), "the wheels that do not slide sideways resist"


def test_a_mirrored_field_gives_the_mirrored_path(driven: Make) -> None:
    errors = {"speed_error": 0.05, "steering_zero_deg": 2.0, "can_delay_s": 0.005}
    disturbed = {
        "start": {"offset_m": 0.1, "heading_deg": 5.0},
        "ground": {"side_slope_deg": 4.0, "slip": 0.05},
        "wheel_errors": errors,
    }
    plain, mirrored = driven(**disturbed), driven(**disturbed, mirrored=True)
    turning = {
        wheel: WheelSetpoint(SPEED_MPS * (1 + 0.1 * index), 0.1 * index) for index, wheel in enumerate(Wheel)
    }

    plain.go(turning, 4.0)
    mirrored.go(
        {
            OPPOSITE[wheel]: WheelSetpoint(each.speed_mps, -each.steering_rad)
            for wheel, each in turning.items()
        },
        4.0,
    )

    one, other = plain.world.now.pose, mirrored.world.now.pose
    assert abs(one.y_m) > 0.05
    assert (other.x_m, other.y_m, other.heading_rad) == pytest.approx(
        (one.x_m, -one.y_m, -one.heading_rad), abs=1e-3
    )


def test_a_robot_that_crabs_over_a_side_slope_is_held_by_its_drives(driven: Make) -> None:
    ends = []
    for slope_deg in (0.0, 4.0):
        run = driven(ground={"side_slope_deg": slope_deg})
        run.go(TURNING, TURNED_S)
        start = run.world.now.pose
        run.go(ACROSS, 4.0)
        end = run.world.now.pose
        ends.append((end.x_m - start.x_m, end.y_m - start.y_m, end.heading_rad - start.heading_rad))

    assert ends[0][1] == pytest.approx(4 * SIDEWAYS_MPS, abs=0.06)
    assert ends[1] == pytest.approx(ends[0], abs=1e-6)


@pytest.mark.parametrize("zero_deg", [-0.5, 2.0])
def test_wheels_that_all_point_aside_carry_the_robot_aside_by_the_tangent(
    zero_deg: float, driven: Make
) -> None:
    run = driven(errors=dict.fromkeys(Wheel, ModuleErrors(1.0, radians(zero_deg))))
    start = run.world.now.pose

    run.go(AHEAD, 4.0)

    end = run.world.now.pose
    assert end.x_m - start.x_m > 1.5
    assert end.y_m - start.y_m == pytest.approx(tan(radians(zero_deg)) * (end.x_m - start.x_m), rel=0.02)
    assert end.heading_rad == pytest.approx(start.heading_rad, abs=1e-6)


def turned_over_way(run: Any) -> float:
    """Change of heading over the way driven, rad/m, while all wheels are told to roll straight ahead."""
    start = run.world.now.pose
    run.go(AHEAD, 3.0)
    end = run.world.now.pose
    return float((end.heading_rad - start.heading_rad) / np.hypot(end.x_m - start.x_m, end.y_m - start.y_m))


def test_front_and_rear_wheels_that_point_apart_turn_the_robot_as_far_as_its_rolling_wheels_let(
    driven: Make,
) -> None:
    zero_rad = radians(0.5)
    errors = {wheel: ModuleErrors(1.0, zero_rad if wheel in FRONT else -zero_rad) for wheel in Wheel}
    run = driven(errors=errors)
    x_m, y_m = run.robot.geometry.position_m(Wheel.FRONT_LEFT)

    curvature = turned_over_way(run)

    # Sideways the wheels ask for zero_rad / x, rolling at one speed on both sides for none.
    sideways, rolling = (SCRUB * x_m) ** 2, y_m**2
    assert curvature == pytest.approx(zero_rad / x_m * sideways / (sideways + rolling), rel=0.05)


def test_faster_wheels_on_the_right_turn_the_robot_left_as_far_as_the_others_let(driven: Make) -> None:
    error = 0.02
    run = driven(errors={wheel: ModuleErrors(1 + error * (wheel in RIGHT), 0.0) for wheel in Wheel})
    x_m, y_m = run.robot.geometry.position_m(Wheel.FRONT_LEFT)

    curvature = turned_over_way(run)

    sideways, rolling = (SCRUB * x_m) ** 2, y_m**2
    assert curvature == pytest.approx(error / (2 * y_m) * rolling / (sideways + rolling), rel=0.05)


def test_module_errors_are_drawn_from_all_of_plus_and_minus_what_is_set() -> None:
    errors = load_field("demo").wheel_errors
    drawn = [each for seed in range(50) for each in module_errors(errors, seed, False).values()]

    for values, most in (
        ([each.speed_factor - 1 for each in drawn], 0.02),
        ([each.steering_zero_rad for each in drawn], radians(0.5)),
    ):
        assert np.abs(values).max() <= most
        assert min(values) < -0.9 * most < 0.9 * most < max(values)


def test_a_delay_on_the_bus_costs_the_way_that_is_driven_in_it(driven: Make) -> None:
    delay_s, ways = 0.1, []
    for can_delay_s in (0.0, delay_s):
        run = driven(wheel_errors={"can_delay_s": can_delay_s})
        start = run.world.now.pose.x_m
        run.go(AHEAD, 3.0)
        ways.append(run.world.now.pose.x_m - start)

    assert ways[0] - ways[1] == pytest.approx(delay_s * SPEED_MPS, abs=0.2 * delay_s * SPEED_MPS)
