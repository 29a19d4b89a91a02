"""What the drill left out, and the meadow about the field."""

import numpy as np
import pytest

from fieldnav.messages import Side
from fieldnav.settings.crop import CropProfile, Plants
from fieldnav.settings.crop import Rows as CropRows
from fieldnav.settings.field import FieldSettings, Gaps, GrassEdge, Rows, Unsown, UnsownRow, Weeds
from fieldnav.settings.loading import load_crop, load_field
from fieldnav.simulation.plan import FieldPlan, sow

BEET = CropProfile(
    name="sugar-beet",
    growth_stage="test",
    rows=CropRows(per_lane=3, spacing_m=0.35),
    plants=Plants(spacing_m=0.2, canopy_width_m=0.2, canopy_height_m=0.12),
    tuned_for="tests",
)
NO_WEEDS = Weeds(per_m2=0, headland_per_m2=0)


def make_field(**changes: object) -> FieldSettings:
    plain = {"name": "test", "crop": "sugar-beet", "lanes": 3, "length_m": 20.0, "seed": 5}
    return FieldSettings.model_validate(plain | changes)


GRASS = GrassEdge(present=True, beyond_ends_m=3, beside_m=1)


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_lane_that_was_not_sown_has_no_plants_and_is_none_to_drive(mirrored):
    field = make_field(lanes=4, mirrored=mirrored, unsown=Unsown(lanes=(3,)))
    plan = sow(field, BEET, Side.RIGHT)
    assert not (plan.plants.is_crop & (plan.plants.lane == 2)).any()
    assert plan.sown_lanes == (0, 1, 3)
    assert np.isfinite(plan.s_first_m).all() and np.isfinite(plan.s_last_m).all()
    assert plan.lane_span_m(2) == pytest.approx((0, 20), abs=0.1)


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_row_that_was_not_sown_is_missing_from_end_to_end(mirrored):
    field = make_field(mirrored=mirrored, unsown=Unsown(rows=(UnsownRow(lane=2, row=1),)))
    plan = sow(field, BEET, Side.RIGHT)
    missing = 2 if mirrored else 0
    rows_there = np.unique(plan.plants.row[plan.plants.is_crop & (plan.plants.lane == 1)])
    assert rows_there.tolist() == [row for row in range(3) if row != missing]
    assert plan.sown.tolist() == [[True] * 3, [row != missing for row in range(3)], [True] * 3]
    assert plan.sown_lanes == (0, 1, 2)


def test_what_is_left_out_moves_no_other_plant_and_no_lane():
    left_out = Unsown(lanes=(3,), rows=(UnsownRow(lane=2, row=3),))
    full, part = (sow(make_field(unsown=unsown), BEET, Side.RIGHT) for unsown in (Unsown(), left_out))
    there = full.plants.is_crop & (full.plants.lane < 2)
    there &= ~((full.plants.lane == 1) & (full.plants.row == 2))
    assert np.array_equal(part.plants.x_m[part.plants.is_crop], full.plants.x_m[there])
    assert np.array_equal(part.rows.lane_n(1, [3.0, 9.0]), full.rows.lane_n(1, [3.0, 9.0]))


def test_a_lane_spans_those_of_its_rows_that_exist():
    ragged = Rows(ragged_m=0.5)
    full = sow(make_field(rows=ragged), BEET, Side.RIGHT)
    longest = int(full.s_last_m[1].argmax())
    without = Unsown(rows=(UnsownRow(lane=2, row=longest + 1),))
    plan = sow(make_field(rows=ragged, unsown=without), BEET, Side.RIGHT)
    others = [row for row in range(3) if row != longest]
    assert full.lane_span_m(1) == (full.s_first_m[1].min(), full.s_last_m[1].max())
    assert plan.lane_span_m(1) == (full.s_first_m[1, others].min(), full.s_last_m[1, others].max())


def test_gaps_by_chance_still_leave_crop_in_a_lane_short_of_a_row():
    gaps = Gaps(germination=0.3, row_gaps_per_10m=5, row_gap_m=(1, 5))
    unsown = Unsown(rows=(UnsownRow(lane=1, row=2),))
    plan = sow(make_field(gaps=gaps, unsown=unsown), BEET, Side.RIGHT)
    stems = np.sort(plan.plants.x_m[plan.plants.is_crop & (plan.plants.lane == 0)])
    assert np.diff(stems).max() < 0.7


def grass_of(field: FieldSettings) -> np.ndarray:
    """Places of what grows about a field without weeds, shape (n, 2)."""
    plan = sow(field, BEET, Side.RIGHT)
    wild = ~plan.plants.is_crop
    assert {plan.species[i] for i in plan.plants.species[wild]} <= {"meadow-grass"}
    return np.stack([plan.plants.x_m, plan.plants.y_m], axis=-1)[wild]


def test_the_grass_begins_where_the_file_says_and_is_dense_all_round():
    field = make_field(grass_edge=GRASS, weeds=NO_WEEDS, rows=Rows(wander_m=0, pass_error_m=0))
    x, y = grass_of(field).T
    right, left = -3.35 - 1, 0.35 + 1  # three lanes to the right, their outermost rows, and a metre
    across = (y > right) & (y < left)
    assert ((x < -3) | (x > 23) | ~across).all()
    for strip in ((x > 23) & (x < 24) & across, (x < -3) & (x > -4) & across):
        assert strip.sum() / (left - right) == pytest.approx(GRASS.tufts_per_m2, rel=0.15)
    beside = (y > left) & (y < left + 1) & (x > 0) & (x < 20)
    assert beside.sum() / 20 == pytest.approx(GRASS.tufts_per_m2, rel=0.15)


def test_a_field_has_no_grass_about_it_unless_asked_for():
    assert len(grass_of(make_field(weeds=NO_WEEDS))) == 0


def test_grass_leaves_crop_and_weeds_where_they_are():
    bare, edged = (sow(make_field(grass_edge=edge), BEET, Side.RIGHT).plants for edge in (GrassEdge(), GRASS))
    assert len(edged) > len(bare)
    assert np.array_equal(edged.x_m[: len(bare)], bare.x_m)


def test_the_whole_field_that_is_shipped_is_twenty_lanes_with_grass_about_them():
    field = load_field("whole-field")
    plan: FieldPlan = sow(field, load_crop(field.crop), Side.LEFT)
    assert plan.sown_lanes == tuple(range(20))
    assert (field.length_m, field.rows.ragged_m, field.rows.spacing_error) == (20, 0.3, 0.1)
    grass = plan.plants.species == plan.species.index("meadow-grass")
    assert (grass & (plan.plants.x_m > 23)).sum() > 5000
