"""Weeds: how many, how large, in patches and in lines that are not rows."""

import numpy as np
import pytest

from fieldnav.messages import Side
from fieldnav.settings.crop import CropProfile, Plants
from fieldnav.settings.crop import Rows as CropRows
from fieldnav.settings.field import FieldSettings, Weeds
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, names_of, revised
from fieldnav.simulation.plan import FieldPlan, sow

BEET = CropProfile(
    name="sugar-beet",
    growth_stage="test",
    rows=CropRows(per_lane=3, spacing_m=0.35),
    plants=Plants(spacing_m=0.2, canopy_width_m=0.2, canopy_height_m=0.12),
    tuned_for="tests",
)


def make_field(**changes: object) -> FieldSettings:
    plain = {"name": "test", "crop": "sugar-beet", "lanes": 3, "length_m": 20.0, "seed": 5}
    return FieldSettings.model_validate(plain | changes)


def places(plan: FieldPlan) -> np.ndarray:
    return np.stack([plan.plants.x_m, plan.plants.y_m], axis=-1)


@pytest.mark.parametrize("patches", [0.0, 0.8])
def test_weeds_are_as_many_as_asked_for_and_few_on_the_headland(patches):
    weeds = Weeds(per_m2=10, headland_per_m2=0.5, patches=patches, large=0)
    plan = sow(make_field(length_m=100, lanes=5, weeds=weeds), BEET, Side.RIGHT)
    weed = ~plan.plants.is_crop
    width = np.ptp(plan.rows.row_n_m) + 2 * 1.6
    inside = (plan.plants.x_m > 0) & (plan.plants.x_m < 100)
    assert (weed & inside).sum() / (width * 100) == pytest.approx(10, rel=0.2)
    assert 0 < (weed & ~inside).sum() / (width * 10) < 1.5
    assert plan.plants.diameter_m[weed].min() >= 0.02
    assert plan.plants.diameter_m[weed].max() <= 0.08


def test_patchy_weeds_crowd_more_than_scattered_ones():
    def crowding(patches: float) -> float:
        weeds = Weeds(per_m2=8, patches=patches, lines=0)
        plan = sow(make_field(length_m=60, weeds=weeds), BEET, Side.RIGHT)
        spots = places(plan)[~plan.plants.is_crop]
        counts = np.histogram2d(spots[:, 0], spots[:, 1], bins=[np.arange(0, 60), np.arange(-4, 1)])[0]
        return float(counts.var() / counts.mean())

    assert crowding(0.8) > 2 * crowding(0.0)


def test_more_weeds_leave_the_crop_where_it_is():
    few, many = (sow(make_field(weeds=Weeds(per_m2=n)), BEET, Side.RIGHT) for n in (1, 20))
    assert np.array_equal(places(few)[few.plants.is_crop], places(many)[many.plants.is_crop])


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5])
def test_the_share_asked_for_is_as_large_as_the_crop(share):
    plan = sow(make_field(length_m=60, weeds=Weeds(per_m2=10, large=share)), BEET, Side.RIGHT)
    weed = ~plan.plants.is_crop
    large = plan.plants.diameter_m[weed] >= 0.7 * BEET.plants.canopy_width_m
    assert large.mean() == pytest.approx(share, abs=0.03)
    assert plan.plants.diameter_m[weed].max() <= 1.1 * BEET.plants.canopy_width_m
    assert plan.plants.height_m[weed][large].min(initial=1.0) > 0.5 * BEET.plants.canopy_height_m


def bearings(lines: float) -> tuple[np.ndarray, np.ndarray]:
    """Of each weed with neighbours: how far off a line through them they are, and its bearing in degrees."""
    weeds = Weeds(per_m2=1, lines=lines, patches=0, headland_per_m2=0)
    plan = sow(make_field(length_m=200, weeds=weeds), BEET, Side.RIGHT)
    spots = places(plan)[~plan.plants.is_crop]
    aside, bearing = [], []
    for spot in spots:
        near = spots[np.hypot(*(spots - spot).T) < 1.0]
        if len(near) > 4:
            values, vectors = np.linalg.eigh(np.cov(near.T))
            aside.append(np.sqrt(values[0]))
            bearing.append(np.degrees(np.arctan2(*vectors[::-1, 1])))
    return np.array(aside), np.abs((np.array(bearing) + 90) % 180 - 90)


def test_weeds_in_lines_stand_in_lines_along_the_rows_and_askew_to_them():
    aside, bearing = bearings(lines=1.0)
    scattered, _ = bearings(lines=0.0)
    assert (aside < 0.08).mean() > 0.6
    assert (scattered < 0.08).mean() < 0.1
    along, askew = (bearing[aside < 0.08] < 3).mean(), (bearing[aside < 0.08] > 5).mean()
    assert along > 0.2 and askew > 0.2


def test_weeds_in_lines_shun_the_crops_rows():
    weeds = Weeds(per_m2=4, lines=1.0, patches=0, headland_per_m2=0)
    plan = sow(make_field(length_m=200, weeds=weeds), BEET, Side.RIGHT)
    weed = ~plan.plants.is_crop
    rows_n = plan.rows.row_n_m.mean(axis=2).ravel()
    from_row = np.abs(plan.plants.y_m[weed][:, None] - rows_n).min(axis=1)
    by_chance = 2 * 0.05 * len(rows_n) / (np.ptp(plan.rows.row_n_m) + 2 * 1.6)
    assert (from_row < 0.05).mean() < 0.8 * by_chance


def test_the_weedy_field_has_more_weeds_than_crop_between_its_rows_too():
    field = load_field("sim-dense-weed")
    crop = load_crop(field.crop)
    plan = sow(revised(field, {"length_m": 40}), crop, Side.RIGHT)
    among = np.abs(plan.plants.y_m[:, None] - plan.rows.lane_n_m).min(axis=1) < 0.5
    in_field = (plan.plants.x_m > 0) & (plan.plants.x_m < 40)
    weeds, beets = among & in_field & ~plan.plants.is_crop, plan.plants.is_crop
    large = plan.plants.diameter_m[weeds] >= 0.7 * crop.plants.canopy_width_m
    assert weeds.sum() >= beets.sum()
    assert large.sum() > beets.sum() / 15


@pytest.mark.parametrize("name", names_of(Kind.FIELD))
def test_every_shipped_field_has_weeds_of_every_kind(name):
    weeds = load_field(name).weeds
    assert min(weeds.per_m2, weeds.large, weeds.lines, weeds.patches, weeds.headland_per_m2) > 0
