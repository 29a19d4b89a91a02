"""What a served robot truly did, on simulated time."""

from collections.abc import Callable
from math import hypot
from typing import Any

import numpy as np
import pytest

from fieldnav.messages import Side, Wheel, WheelSetpoint
from fieldnav.settings.loading import load_crop, load_field, revised
from fieldnav.simulation.plan import FieldPlan, sow
from fieldnav.simulation.served.witness import Witness, passes


@pytest.fixture(scope="module")
def plan() -> FieldPlan:
    changes = {"lanes": 2, "length_m": 6, "rows": {"wander_m": 0, "pass_error_m": 0}}
    return sow(revised(load_field("demo"), changes), load_crop("sugar-beet"), Side.RIGHT)


def along(plan: FieldPlan, lane: int, *s_m: float) -> list[tuple[float, float]]:
    """Places on the middle of a lane."""
    at = [plan.centreline.position(s, float(plan.rows.lane_n(lane, np.array(s)))) for s in s_m]
    return [(float(x), float(y)) for x, y in at]


def driven(path: list[tuple[float, float]], plan: FieldPlan) -> list[int]:
    return passes(plan, np.array(path)).tolist()


def test_a_lane_is_one_pass_from_end_to_end(plan: FieldPlan) -> None:
    assert driven(along(plan, 0, -1, 1, 3, 5, 7), plan) == [0, 1, 1, 1, 1]


def test_the_next_lane_and_the_same_lane_again_are_other_passes(plan: FieldPlan) -> None:
    path = [*along(plan, 0, 1, 5, 8), *along(plan, 1, 8, 5, 1, -1), *along(plan, 1, 1, 5)]

    assert driven(path, plan) == [1, 1, 1, 1, 2, 2, 2, 3, 3]


def test_turning_back_within_a_lane_is_no_other_pass(plan: FieldPlan) -> None:
    assert driven(along(plan, 0, 1, 4, 2, 5), plan) == [1, 1, 1, 1]


def test_a_path_of_no_places_has_no_passes(plan: FieldPlan) -> None:
    assert passes(plan, np.zeros((0, 2))).tolist() == []


def test_a_lane_driven_twice_is_told_as_such(driven: Callable[..., Any]) -> None:
    robot = driven()
    witness = Witness(robot.world)
    start = robot.world.now.pose
    ahead = {wheel: WheelSetpoint(1.0, 0.0) for wheel in Wheel}
    back = {wheel: WheelSetpoint(-1.0, 0.0) for wheel in Wheel}

    def look(now_s: float) -> None:
        witness.note()

    robot.go(ahead, 10, look)
    once = witness.account(1)
    robot.go(back, 11, look)
    twice = witness.account(1)

    assert (once.truth.lanes_missed, once.truth.lanes_repeated) == (0, 0)
    assert once.distance_m == pytest.approx(
        hypot(once.pose.x_m - start.x_m, once.pose.y_m - start.y_m), abs=0.05
    )
    assert once.truth.cross_track_cm.mean == pytest.approx(0, abs=1)
    assert (twice.truth.lanes_missed, twice.truth.lanes_repeated) == (0, 1)


def test_a_robot_that_only_stood_has_missed_its_lanes(driven: Callable[..., Any]) -> None:
    robot = driven(ready=False)
    witness = Witness(robot.world)

    robot.go({}, 1, lambda now_s: witness.note())
    account = witness.account(1)

    assert account.distance_m == 0 and account.pose == robot.world.now.pose
    assert account.truth.lanes_missed == 1 and account.truth.cross_track_cm.mean is None


def test_plants_under_the_wheels_are_counted(driven: Callable[..., Any]) -> None:
    robot = driven()
    witness = Witness(robot.world)
    aside = {wheel: WheelSetpoint(0.7, 0.5) for wheel in Wheel}  # the wheels cross the rows

    robot.go(aside, 8, lambda now_s: witness.note())

    assert witness.account(1).truth.crop_plants_run_over > 0
