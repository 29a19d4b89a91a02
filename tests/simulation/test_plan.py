"""Where rows run and plants stand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.errors import SettingsError
from fieldnav.messages import Side
from fieldnav.settings.crop import CropProfile, Plants
from fieldnav.settings.crop import Rows as CropRows
from fieldnav.settings.field import FieldSettings, Gaps, Rows, Shape, Weeds
from fieldnav.simulation.centreline import Centreline
from fieldnav.simulation.plan import FieldPlan, sow

BEET = CropProfile(
    name="sugar-beet",
    growth_stage="test",
    rows=CropRows(per_lane=3, spacing_m=0.35),
    plants=Plants(spacing_m=0.2, canopy_width_m=0.2, canopy_height_m=0.12),
    tuned_for="tests",
)
TIDY_ROWS = Rows(wander_m=0, pass_error_m=0, scatter_m=0, ragged_m=0)
NO_GAPS = Gaps(germination=1, row_gaps_per_10m=0)
NO_WEEDS = Weeds(per_m2=0, headland_per_m2=0)


def make_field(**changes: object) -> FieldSettings:
    plain = {"name": "test", "crop": "sugar-beet", "lanes": 3, "length_m": 20.0, "seed": 5}
    return FieldSettings.model_validate(plain | changes)


def places(plan: FieldPlan) -> np.ndarray:
    return np.stack([plan.plants.x_m, plan.plants.y_m], axis=-1)


def test_a_tidy_field_has_its_plants_on_a_grid():
    field = make_field(rows=TIDY_ROWS, gaps=NO_GAPS, weeds=NO_WEEDS)
    plan = sow(field, BEET, Side.RIGHT)
    plants = plan.plants
    assert len(plants) == 3 * 3 * 101
    expected = -1.5 * plants.lane + 0.35 * (plants.row - 1)
    assert np.allclose(plants.y_m, expected)
    assert np.allclose(plan.s_first_m, 0)
    assert np.allclose(plan.s_last_m, 20)


@pytest.mark.parametrize(("side", "sign"), [(Side.LEFT, 1), (Side.RIGHT, -1)])
def test_lanes_follow_each_other_on_the_side_asked_for(side, sign):
    plan = sow(make_field(rows=TIDY_ROWS), BEET, side)
    assert np.allclose(plan.rows.lane_n_m, [0, sign * 1.5, sign * 3.0])


def test_the_same_seed_gives_the_same_plants_and_another_seed_others():
    first, again = (sow(make_field(), BEET, Side.RIGHT) for _ in range(2))
    other = sow(make_field(seed=6), BEET, Side.RIGHT)
    assert np.array_equal(places(first), places(again))
    assert not np.array_equal(first.plants.x_m[:50], other.plants.x_m[:50])


def test_a_mirrored_field_is_the_mirror_image_of_the_field_sown_to_the_other_side():
    curved = Rows(shape=Shape.CURVED)
    plain = sow(make_field(rows=curved), BEET, Side.RIGHT)
    mirrored = sow(make_field(rows=curved, mirrored=True), BEET, Side.LEFT)
    assert np.array_equal(places(mirrored), places(plain) * [1, -1])
    assert np.array_equal(mirrored.rows.lane_n_m, -plain.rows.lane_n_m)
    assert np.array_equal(mirrored.s_first_m, plain.s_first_m[:, ::-1])
    s = np.linspace(-3, 23, 50)
    assert np.array_equal(mirrored.centreline.position(s), plain.centreline.position(s) * [1, -1])


def test_rows_in_a_mirrored_field_count_from_right_to_left_too():
    plan = sow(make_field(mirrored=True), BEET, Side.RIGHT)
    crop = plan.plants.is_crop & (plan.plants.lane == 0)
    heights = [plan.plants.y_m[crop & (plan.plants.row == row)].mean() for row in range(3)]
    assert heights == sorted(heights)


def test_rows_end_raggedly_but_within_the_limit_and_where_their_last_plants_stand():
    plan = sow(make_field(rows=Rows(ragged_m=0.4, wander_m=0, pass_error_m=0)), BEET, Side.RIGHT)
    assert np.abs(plan.s_first_m).max() <= 0.4
    assert np.abs(plan.s_last_m - 20).max() <= 0.4
    assert plan.s_last_m.std() > 0.1
    for lane in range(3):
        for row in range(3):
            own = plan.plants.is_crop & (plan.plants.lane == lane) & (plan.plants.row == row)
            assert plan.plants.x_m[own].min() == pytest.approx(plan.s_first_m[lane, row], abs=1e-6)
            assert plan.plants.x_m[own].max() == pytest.approx(plan.s_last_m[lane, row], abs=1e-6)


def test_rows_wander_as_far_as_asked_and_mostly_together():
    field = make_field(
        length_m=1000, lanes=2, rows=Rows(wander_m=0.02, pass_error_m=0, scatter_m=0), weeds=NO_WEEDS
    )
    plan = sow(field, BEET, Side.RIGHT)
    straight = plan.rows.row_n_m - plan.rows.row_n_m.mean(axis=2, keepdims=True)
    assert straight.std() == pytest.approx(0.02, rel=0.25)
    assert np.corrcoef(straight[0, 0], straight[0, 2])[0, 1] > 0.5
    assert abs(np.corrcoef(straight[0, 0], straight[1, 0])[0, 1]) < 0.5


def test_the_wander_of_the_rows_is_correlated_over_the_length_asked_for():
    length_m = 5.0
    rows = Rows(wander_m=0.02, pass_error_m=0, wander_length_m=length_m, scatter_m=0)
    plan = sow(make_field(length_m=1000, lanes=4, rows=rows, weeds=NO_WEEDS), BEET, Side.RIGHT)
    lag = round(length_m / (plan.rows.s_m[1] - plan.rows.s_m[0]))
    away = plan.rows.row_n_m - plan.rows.row_n_m.mean(axis=2, keepdims=True)
    alike = (away[..., lag:] * away[..., :-lag]).mean() / (away**2).mean()
    far_apart = (away[..., 4 * lag :] * away[..., : -4 * lag]).mean() / (away**2).mean()
    assert alike == pytest.approx(np.exp(-1 / 2), abs=0.1)
    assert abs(far_apart) < 0.15


def test_plants_are_scattered_about_their_row_as_far_as_asked():
    field = make_field(
        length_m=200, rows=Rows(wander_m=0.02, pass_error_m=0, scatter_m=0.015), weeds=NO_WEEDS
    )
    plan = sow(field, BEET, Side.RIGHT)
    plants = plan.plants
    aside = [
        plants.y_m[i] - plan.rows.row_n(int(plants.lane[i]), int(plants.row[i]), plants.x_m[i])
        for i in range(0, len(plants), 5)
    ]
    assert np.std(aside) == pytest.approx(0.015, rel=0.1)
    assert np.mean(aside) == pytest.approx(0, abs=0.002)


def test_uneven_row_distances_leave_the_lane_where_it_is():
    field = make_field(rows=Rows(spacing_error=0.1, wander_m=0, pass_error_m=0), lanes=20)
    plan = sow(field, BEET, Side.RIGHT)
    distances = np.diff(plan.rows.row_n_m[:, :, 0], axis=1)
    assert np.abs(distances - 0.35).max() <= 0.035
    assert distances.std() > 0.005
    assert np.allclose(plan.rows.row_n_m[:, :, 0].mean(axis=1), plan.rows.lane_n_m)


def test_plants_near_a_point_are_those_within_the_radius():
    plan = sow(make_field(), BEET, Side.RIGHT)
    found = plan.plants_near((10.0, -1.0), 0.6)
    distance = np.hypot(plan.plants.x_m - 10, plan.plants.y_m + 1)
    assert found.tolist() == np.flatnonzero(distance <= 0.6).tolist()
    assert len(found) > 5


def test_the_place_in_a_lane_is_told_against_the_middle_of_its_rows():
    plan = sow(
        make_field(length_m=100, rows=Rows(shape=Shape.CURVED, wander_m=0.05, pass_error_m=0)),
        BEET,
        Side.RIGHT,
    )
    s = np.linspace(1, 99, 60)
    middle = plan.centreline.position(s, plan.rows.lane_n(2, s))
    found_s, offset, heading = plan.in_lane(2, middle)
    assert np.allclose(found_s, s, atol=1e-6)
    assert np.allclose(offset, 0, atol=1e-6)
    steps = np.diff(middle, axis=0)
    along = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    assert np.abs(along - (heading[1:] + heading[:-1]) / 2).max() < 0.02


@given(s=st.floats(-10, 70), n=st.floats(-6, 6), radius=st.floats(15, 100))
def test_projecting_a_point_of_a_curved_field_gives_back_its_coordinates(s, n, radius):
    line = Centreline(60.0, 1 / radius, 40.0)
    found_s, found_n, heading = line.project(line.position(s, n))
    assert float(found_s) == pytest.approx(s, abs=1e-5)
    assert float(found_n) == pytest.approx(n, abs=1e-5)
    assert float(heading) == pytest.approx(float(line.heading(s)), abs=1e-6)


def test_a_curved_centre_line_has_unit_speed_and_starts_straight():
    line = Centreline(80.0, 1 / 25, 40.0)
    s = np.linspace(-5, 85, 9001)
    steps = np.diff(line.position(s), axis=0)
    assert np.allclose(np.hypot(steps[:, 0], steps[:, 1]), s[1] - s[0], rtol=1e-5)
    assert float(line.heading(0)) == 0
    assert np.allclose(line.position([-5, 0]), [[-5, 0], [0, 0]])
    assert np.abs(line.curvature(s)).max() == pytest.approx(1 / 25, rel=1e-3)


def test_a_bend_too_tight_for_its_lanes_is_refused_by_name():
    with pytest.raises(SettingsError, match=r"rows.radius_m 8"):
        sow(make_field(lanes=10, rows=Rows(shape=Shape.CURVED, radius_m=8)), BEET, Side.RIGHT)
    with pytest.raises(SettingsError, match="wavelength_m"):
        sow(make_field(rows=Rows(shape=Shape.CURVED, wavelength_m=300)), BEET, Side.RIGHT)


def test_a_crop_that_cannot_be_drawn_is_refused_and_a_variety_is_drawn_as_its_crop():
    assert (
        sow(make_field(), BEET.model_copy(update={"name": "sugar-beet-late"}), Side.LEFT).species[0]
        == "sugar-beet"
    )
    with pytest.raises(SettingsError, match="tulip"):
        sow(make_field(), BEET.model_copy(update={"name": "tulip"}), Side.LEFT)


def test_each_pass_of_the_drill_lies_a_little_off_its_place() -> None:
    field = make_field(lanes=40, length_m=6.0)

    lanes_n = sow(field, BEET, Side.LEFT).rows.lane_n_m

    off = lanes_n - field.lane_pitch_m * np.arange(field.lanes)
    most = field.rows.pass_error_m
    assert off[0] == 0 and np.abs(off).max() <= most
    assert off[1:].std() == pytest.approx(most / np.sqrt(3), rel=0.25)
