"""The crops, robots and fields that come with fieldnav."""

from importlib.resources import files

import pytest

from fieldnav.settings.fit import check_fit, outer_canopy_m
from fieldnav.settings.kinds import Kind, names_of
from fieldnav.settings.loading import load, load_crop, load_field, load_robot

PAPER_LENGTHS_M = {"beans": 52, "potato": 37, "coriander": 54, "sugar-beet": 69, "lemon-balm": 40}
EVERY_FILE = [(kind, name) for kind in Kind for name in names_of(kind)]


def test_all_that_the_design_lists_is_shipped() -> None:
    crops = {"sugar-beet", "coriander", "potato", "beans", "lemon-balm", "maize", "soybean", "winter-wheat"}
    fields = {"demo", "whole-field", "sim-curved", "sim-large-gaps", "sim-dense-weed", *PAPER_LENGTHS_M}

    assert set(names_of(Kind.CROP)) == crops
    assert set(names_of(Kind.ROBOT)) == {"bonnbot", "thorvald"}
    assert fields <= set(names_of(Kind.FIELD))


@pytest.mark.parametrize(("kind", "name"), EVERY_FILE)
def test_every_shipped_file_loads_under_its_own_name(kind: Kind, name: str) -> None:
    assert load(kind, name).name == name


@pytest.mark.parametrize(("kind", "name"), EVERY_FILE)
def test_every_shipped_file_says_at_its_head_what_it_is_and_how_to_change_it(kind: Kind, name: str) -> None:
    text = (files("config") / kind.value / f"{name}.yaml").read_text()
    head = text.split("\n\n")[0]

    assert all(line.startswith("#") for line in head.splitlines())
    assert "copy" in head.lower()


@pytest.mark.parametrize("robot", names_of(Kind.ROBOT))
@pytest.mark.parametrize("crop", names_of(Kind.CROP))
def test_every_crop_fits_between_the_wheels_of_every_robot(crop: str, robot: str) -> None:
    check_fit(load_crop(crop), load_robot(robot), lane_pitch_m=1.5)


@pytest.mark.parametrize("crop", names_of(Kind.CROP))
def test_every_crop_fits_the_lane_of_the_paper(crop: str) -> None:
    assert 2 * outer_canopy_m(load_crop(crop)) <= 1.25


@pytest.mark.parametrize("crop", names_of(Kind.CROP))
def test_soil_shows_between_the_rows_of_every_crop(crop: str) -> None:
    profile = load_crop(crop)

    assert profile.plants.canopy_width_m < profile.rows.spacing_m


@pytest.mark.parametrize("crop", names_of(Kind.CROP))
def test_no_single_plant_of_a_crop_is_divided(crop: str) -> None:
    profile = load_crop(crop)

    assert profile.vegetation.tallest_region_m >= profile.plants.canopy_width_m


@pytest.mark.parametrize(("name", "length_m"), PAPER_LENGTHS_M.items())
def test_the_fields_of_the_paper_are_as_long_as_the_paper_drove(name: str, length_m: float) -> None:
    field = load_field(name)

    assert (field.crop, field.length_m, field.lanes) == (name, length_m, 3)


@pytest.mark.parametrize("name", names_of(Kind.FIELD))
def test_no_gap_in_a_field_is_longer_than_what_its_crop_lets_the_robot_coast(name: str) -> None:
    field = load_field(name)

    assert field.gaps.lane_gap_m[1] <= load_crop(field.crop).row_end.longest_gap_m


def test_bonnbot_is_the_robot_of_the_paper() -> None:
    robot = load_robot("bonnbot")
    camera = robot.cameras.front

    assert (robot.geometry.track_m, robot.geometry.length_m, robot.geometry.clearance_m) == (1.4, 1.4, 0.86)
    assert (camera.width_px, camera.height_px, camera.rate_hz, camera.tilt_deg) == (1280, 720, 15, 65)
    assert robot.cameras.front.model_dump(exclude={"source"}) == robot.cameras.rear.model_dump(
        exclude={"source"}
    )
