"""A path is judged against the lane that is nearest, and judging takes no more memory for more lanes."""

import tracemalloc

import numpy as np
import pytest

from fieldnav.evaluation.path import TruePath
from fieldnav.evaluation.truth import nearest_lane
from fieldnav.messages import Floats, Side
from fieldnav.settings.loading import load_crop, load_field, revised
from fieldnav.simulation.plan import FieldPlan, sow


def plan_of(lanes: int) -> FieldPlan:
    field = revised(load_field("demo"), {"lanes": lanes, "length_m": 5.0})
    return sow(field, load_crop("sugar-beet"), Side.RIGHT)


def strewn(plan: FieldPlan, count: int) -> Floats:
    """Places all over the field and about it, shape (count, 2)."""
    width_m = plan.lanes * 1.5
    return np.random.default_rng(1).uniform([-1.0, -width_m], [6.0, 1.5], (count, 2))


def test_every_place_is_judged_against_the_lane_that_is_nearest() -> None:
    plan = plan_of(4)
    xy = strewn(plan, 500)

    lane, (s_m, offset_m, heading_rad) = nearest_lane(plan, xy)

    everywhere = np.array([plan.in_lane(each, xy) for each in plan.sown_lanes])  # lane, quantity, place
    which = np.abs(everywhere[:, 1]).argmin(axis=0)
    assert set(lane) == set(plan.sown_lanes)
    assert (lane == np.array(plan.sown_lanes)[which]).all()
    assert (np.array([s_m, offset_m, heading_rad]) == everywhere[which, :, np.arange(500)].T).all()


def peak_bytes(plan: FieldPlan, xy: Floats) -> int:
    tracemalloc.start()
    nearest_lane(plan, xy)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


def test_the_memory_that_judging_takes_does_not_grow_with_the_lanes() -> None:
    few, many = plan_of(2), plan_of(12)

    assert peak_bytes(many, strewn(many, 20_000)) < 2 * peak_bytes(few, strewn(few, 20_000))


def test_an_hour_of_the_true_path_takes_12_megabytes() -> None:
    path = TruePath()
    for numbers in (
        path.stamp_s,
        path.x_m,
        path.y_m,
        path.heading_rad,
        path.yaw_rate_rps,
        path.steering_rate_rps,
    ):
        numbers.extend([0.0] * 180_000)
    for counts in (path.lanes, path.rows_passed):
        counts.extend([0] * 180_000)
    path.states.extend([()] * 180_000)

    assert path.held_bytes / 1e6 == pytest.approx(12, abs=1)
