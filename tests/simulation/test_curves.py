"""Rows of a curved field: parallel, evenly sown, bent as their place in the bend says."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from fieldnav.messages import Side
from fieldnav.settings.loading import load_crop, load_field, revised
from fieldnav.simulation.plan import FieldPlan, sow

RADIUS_M, SPACING_M, STEP_M = 12.0, 0.35, 0.05
TIDY = {"wander_m": 0, "pass_error_m": 0, "scatter_m": 0, "ragged_m": 0}


@pytest.fixture(scope="module", params=Side, ids=lambda side: side.value)
def curved(request: pytest.FixtureRequest) -> FieldPlan:
    """The shipped curved field, two bends each way, its rows as by a ruler and its plants all up."""
    shipped = load_field("sim-curved")
    rows = shipped.rows.model_dump(mode="json") | TIDY
    gaps = {"germination": 1, "row_gaps_per_10m": 0}
    field = revised(shipped, {"length_m": 80, "rows": rows, "gaps": gaps, "weeds": {"per_m2": 0}})
    return sow(field, load_crop(field.crop), request.param)


def line_of(plan: FieldPlan, lane: int, row: int, margin_m: float = 0.0) -> np.ndarray:
    """Points of a row, shape (n, 2); margin_m: how far in from the field's ends."""
    s = np.arange(margin_m, 80 - margin_m, STEP_M)
    return plan.centreline.position(s, plan.rows.row_n(lane, row, s))


def curvature_of(line: np.ndarray) -> np.ndarray:
    """Curvature from the points alone, 1/m, shape (n - 2,)."""
    steps = np.diff(line, axis=0)
    turns = np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0])))
    lengths = np.hypot(*steps.T)
    return turns / ((lengths[1:] + lengths[:-1]) / 2)


def test_the_first_lane_bends_to_twelve_metres_both_ways(curved):
    bends = curvature_of(line_of(curved, 0, 1))
    assert bends.max() == pytest.approx(1 / RADIUS_M, rel=0.01)
    assert bends.min() == pytest.approx(-1 / RADIUS_M, rel=0.01)


@pytest.mark.parametrize(("lane", "row"), [(0, 0), (0, 2), (1, 1), (2, 0), (2, 2)])
def test_a_row_bends_tighter_inside_and_wider_outside_by_its_distance(curved, lane, row):
    n = float(curved.rows.row_n_m[lane, row].mean())
    bends = curvature_of(line_of(curved, lane, row))
    assert bends.max() == pytest.approx(1 / (RADIUS_M - n), rel=0.01)
    assert bends.min() == pytest.approx(-1 / (RADIUS_M + n), rel=0.01)


def test_rows_keep_their_distance_all_along_and_none_folds_back(curved):
    for lane in range(3):
        for row in range(3):
            steps = np.diff(line_of(curved, lane, row), axis=0)
            assert ((steps[1:] * steps[:-1]).sum(axis=1) > 0).all()
        for row in range(2):
            inner = line_of(curved, lane, row, margin_m=1.0)
            apart_m = cKDTree(line_of(curved, lane, row + 1)).query(inner)[0]
            assert np.allclose(apart_m, SPACING_M, atol=0.005)


def test_plants_stand_equally_far_apart_inside_and_outside_of_a_bend(curved):
    plants, spacing_m = curved.plants, load_crop("sugar-beet").plants.spacing_m
    for lane, row in ((0, 1), (2, 0), (2, 2)):
        own = plants.is_crop & (plants.lane == lane) & (plants.row == row)
        s, _, _ = curved.centreline.project(np.stack([plants.x_m[own], plants.y_m[own]], axis=-1))
        apart_m = np.hypot(np.diff(plants.x_m[own]), np.diff(plants.y_m[own]))
        bend = curved.centreline.curvature(s[1:])
        for side in (bend > 1 / 20, bend < -1 / 20):
            assert apart_m[side].mean() == pytest.approx(spacing_m, rel=0.04)


def test_a_placed_gap_is_as_long_along_an_outer_lane_as_the_file_says():
    shipped = load_field("sim-curved")
    gap = {"lane": 3, "start_m": 24, "length_m": 5}  # in a bend that this lane is outside of
    field = revised(shipped, {"length_m": 40, "gaps": {"placed": [gap]}, "weeds": {"per_m2": 0}})
    plan = sow(field, load_crop(field.crop), Side.LEFT)
    own = plan.plants.is_crop & (plan.plants.lane == 2)
    s = np.sort(plan.centreline.project(np.stack([plan.plants.x_m[own], plan.plants.y_m[own]], axis=-1))[0])
    gap_at = int(np.diff(s).argmax())
    along = np.linspace(s[gap_at], s[gap_at + 1], 500)
    line = plan.centreline.position(along, plan.rows.lane_n(2, along))
    length_m = float(np.hypot(*np.diff(line, axis=0).T).sum())
    assert length_m == pytest.approx(5, abs=0.35)
    assert s[gap_at + 1] - s[gap_at] < 4.4
