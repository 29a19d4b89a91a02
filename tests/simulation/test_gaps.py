"""Where plants are missing, by chance and on purpose, and that crop is never farther than the file says."""

import numpy as np
import pytest

from fieldnav.messages import Side
from fieldnav.settings.crop import CropProfile, Plants
from fieldnav.settings.crop import Rows as CropRows
from fieldnav.settings.field import FieldSettings, Gaps, PlacedGap, Rows, Weeds
from fieldnav.settings.loading import load_crop, load_field, revised
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


TIDY_ROWS = Rows(wander_m=0, pass_error_m=0, scatter_m=0, ragged_m=0)
NO_GAPS = {"germination": 1, "row_gaps_per_10m": 0}
BESIDE_M = 0.25
"""The nearest of a lane's seeds is no farther from a gap's end, on either side."""
PIECES_M = 0.6
"""No longer stretch is empty in all rows where no gap across the lane is."""


def longest_hole_m(plan: FieldPlan, lane: int) -> float:
    """The longest stretch of a straight lane in which no row has a plant."""
    stems = np.sort(plan.plants.x_m[plan.plants.is_crop & (plan.plants.lane == lane)])
    return float(np.diff(stems).max())


def stems_of(plan: FieldPlan, lane: int, row: int) -> np.ndarray:
    own = plan.plants.is_crop & (plan.plants.lane == lane) & (plan.plants.row == row)
    return np.sort(plan.plants.x_m[own])


def test_germination_thins_the_rows_by_its_share():
    field = make_field(length_m=200, gaps=Gaps(germination=0.7, row_gaps_per_10m=0), weeds=NO_WEEDS)
    plan = sow(field, BEET, Side.RIGHT)
    assert len(plan.plants) / (9 * 1001) == pytest.approx(0.7, abs=0.02)


def test_lane_gaps_empty_all_rows_of_a_lane_and_keep_both_row_ends():
    gaps = Gaps(germination=1, row_gaps_per_10m=0, lane_gaps_per_10m=0.8, lane_gap_m=(1.5, 1.5))
    field = make_field(length_m=100, rows=TIDY_ROWS, gaps=gaps, weeds=NO_WEEDS)
    plan = sow(field, BEET, Side.RIGHT)
    for lane in range(3):
        stems = np.sort(plan.plants.x_m[plan.plants.lane == lane])
        holes = np.diff(stems)
        assert 3 <= (holes > 1).sum() <= 12
        assert holes.max() < 1.5 + 2 * 0.2 + 0.2
        assert np.diff(stems[stems < 1]).max() < 0.4
        assert np.diff(stems[stems > 99]).max() < 0.4


@pytest.mark.parametrize("length_m", [20, 60])
def test_no_gap_across_a_lane_of_the_shipped_field_is_longer_than_its_file_says(length_m):
    field = load_field("sim-large-gaps")
    crop, most_m = load_crop(field.crop), field.gaps.lane_gap_m[1]
    for seed in range(40):
        plan = sow(revised(field, {"length_m": length_m, "seed": seed}), crop, Side.RIGHT)
        holes = [longest_hole_m(plan, lane) for lane in range(plan.lanes)]
        assert max(holes) <= most_m + 2 * BESIDE_M, f"seed {seed}"


@pytest.mark.parametrize("seed", range(20))
def test_gaps_in_single_rows_never_add_up_to_one_across_the_lane(seed):
    gaps = Gaps(germination=0.3, row_gaps_per_10m=5, row_gap_m=(1, 5))
    plan = sow(make_field(seed=seed, rows=TIDY_ROWS, gaps=gaps), BEET, Side.RIGHT)
    assert max(longest_hole_m(plan, lane) for lane in range(3)) <= PIECES_M + 0.1
    assert max(np.diff(stems_of(plan, lane, row)).max() for lane in range(3) for row in range(3)) > 2


@pytest.mark.parametrize("seed", range(20))
def test_thin_rows_full_of_gaps_never_carry_a_gap_across_the_lane_on(seed):
    across = {"lane_gaps_per_10m": 1, "lane_gap_m": (1.5, 1.5)}
    full, thin = (
        Gaps(**NO_GAPS, **across),
        Gaps(germination=0.3, row_gaps_per_10m=5, row_gap_m=(1, 5), **across),
    )
    holes = []
    for gaps in (full, thin):
        plan = sow(make_field(seed=seed, lanes=6, gaps=gaps), BEET, Side.RIGHT)
        stems = [np.sort(plan.plants.x_m[plan.plants.is_crop & (plan.plants.lane == n)]) for n in range(6)]
        holes.append([hole for lane in stems for hole in np.diff(lane) if hole > 1])
    assert len(holes[0]) > 0
    assert holes[1] == pytest.approx(holes[0], abs=0.01)


def test_a_lane_of_a_single_row_has_the_gaps_of_its_row():
    single = BEET.model_copy(update={"rows": CropRows(per_lane=1, spacing_m=0.35)})
    gaps = Gaps(germination=1, row_gaps_per_10m=3, row_gap_m=(2, 2))
    plan = sow(make_field(rows=TIDY_ROWS, gaps=gaps), single, Side.RIGHT)
    assert longest_hole_m(plan, 0) > 2


def test_the_shipped_field_has_rows_that_lack_plants_for_metres():
    field = load_field("sim-large-gaps")
    plan = sow(revised(field, {"length_m": 60}), load_crop(field.crop), Side.RIGHT)
    longest = [np.diff(stems_of(plan, lane, row)).max() for lane in range(3) for row in range(3)]
    assert max(longest) > 4


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_gap_placed_in_one_row_is_in_that_row_alone(mirrored):
    gaps = Gaps(placed=(PlacedGap(lane=2, row=1, start_m=8, length_m=5),), **NO_GAPS)
    plan = sow(make_field(gaps=gaps, rows=TIDY_ROWS, mirrored=mirrored), BEET, Side.RIGHT)
    for lane in range(3):
        for row in range(3):
            stems = stems_of(plan, lane, row)
            inside = int(((stems > 8) & (stems < 13)).sum())
            named = (lane, row) == (1, 2 if mirrored else 0)
            assert inside == 0 if named else 20 < inside < 30


def test_a_gap_placed_in_all_rows_is_as_long_as_asked_whatever_chance_adds():
    gaps = Gaps(
        germination=0.8,
        row_gaps_per_10m=3,
        lane_gaps_per_10m=1,
        lane_gap_m=(0.5, 1.0),
        placed=(PlacedGap(lane=1, start_m=8, length_m=2),),
    )
    for seed in range(20):
        plan = sow(make_field(gaps=gaps, seed=seed), BEET, Side.RIGHT)
        stems = np.sort(plan.plants.x_m[plan.plants.is_crop & (plan.plants.lane == 0)])
        assert not ((stems > 8) & (stems < 10)).any(), f"seed {seed}"
        assert 8 - stems[stems <= 8].max() < BESIDE_M and stems[stems >= 10].min() - 10 < BESIDE_M


def test_a_gap_placed_at_a_rows_end_ends_the_row_sooner():
    placed = (PlacedGap(lane=1, row=2, start_m=15, length_m=5), PlacedGap(lane=2, start_m=0, length_m=3))
    plan = sow(make_field(gaps=Gaps(placed=placed, **NO_GAPS)), BEET, Side.RIGHT)
    assert plan.s_last_m[0, 1] == pytest.approx(15, abs=BESIDE_M)
    assert plan.s_last_m[0, 0] == pytest.approx(20, abs=0.1)
    assert plan.s_first_m[1] == pytest.approx([3, 3, 3], abs=BESIDE_M)


def test_a_placed_gap_leaves_every_other_plant_where_it_is():
    plain, gappy = (
        sow(make_field(gaps=Gaps(placed=placed)), BEET, Side.RIGHT)
        for placed in ((), (PlacedGap(lane=1, row=3, start_m=5, length_m=2),))
    )
    crop = plain.plants.is_crop
    kept = crop & ~(
        (plain.plants.lane == 0) & (plain.plants.row == 2) & (plain.plants.x_m > 5) & (plain.plants.x_m < 7)
    )
    assert np.array_equal(gappy.plants.x_m[gappy.plants.is_crop], plain.plants.x_m[kept])
