"""Rows and wheels must not share the ground."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fieldnav.errors import SettingsError
from fieldnav.settings.fit import check_fit, check_size
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, load_robot, names_of, revised

BEET, BONNBOT = load_crop("sugar-beet"), load_robot("bonnbot")


def test_rows_that_reach_under_the_wheels_are_refused() -> None:
    wide = BEET.model_copy(update={"rows": BEET.rows.model_copy(update={"per_lane": 4})})

    with pytest.raises(
        SettingsError,
        match=r"rows.per_lane 4 .* rows.spacing_m 0.35 and plants.canopy_width_m 0.2 reach 0.625 m .* "
        r"at most 0.620 m, .* geometry.track_m 1.4 and geometry.wheel_width_m 0.16",
    ):
        check_fit(
            wide.model_copy(update={"plants": BEET.plants.model_copy(update={"canopy_width_m": 0.2})}),
            BONNBOT,
        )


def test_a_canopy_higher_than_the_robot_is_refused() -> None:
    low = BONNBOT.model_copy(update={"geometry": BONNBOT.geometry.model_copy(update={"clearance_m": 0.1})})

    with pytest.raises(SettingsError, match=r"canopy_height_m 0.12; allowed is .* geometry.clearance_m 0.1"):
        check_fit(BEET, low)


def test_lanes_too_close_for_the_wheels_are_refused() -> None:
    with pytest.raises(SettingsError, match=r"lane_pitch_m 1.2 is too small .* at least 1.23"):
        check_fit(BEET, BONNBOT, lane_pitch_m=1.2)


@given(st.integers(1, 8), st.floats(0.1, 1.5), st.floats(0.02, 1.2))
def test_a_crop_fits_exactly_when_no_canopy_reaches_a_wheel(
    per_lane: int, spacing_m: float, canopy_m: float
) -> None:
    crop = BEET.model_copy(
        update={
            "rows": BEET.rows.model_copy(update={"per_lane": per_lane, "spacing_m": spacing_m}),
            "plants": BEET.plants.model_copy(update={"canopy_width_m": canopy_m}),
        }
    )
    rows_m = [(row - (per_lane - 1) / 2) * spacing_m for row in range(per_lane)]
    reach_m = max(abs(row_m) + canopy_m / 2 for row_m in rows_m)
    assume(abs(reach_m - 0.62) > 1e-9)

    if reach_m < 0.62:
        check_fit(crop, BONNBOT)
    else:
        with pytest.raises(SettingsError):
            check_fit(crop, BONNBOT)


@pytest.mark.parametrize("pitch_m", [1.0, 1.2, 1.2299])
def test_the_lane_pitch_that_is_said_to_be_allowed_is_allowed(pitch_m: float) -> None:
    wide = BEET.model_copy(update={"plants": BEET.plants.model_copy(update={"canopy_width_m": 0.2034})})

    with pytest.raises(SettingsError) as caught:
        check_fit(wide, BONNBOT, lane_pitch_m=pitch_m)

    check_fit(wide, BONNBOT, lane_pitch_m=float(str(caught.value).rsplit(maxsplit=1)[-1]))


def test_every_shipped_field_is_small_enough_to_be_sown() -> None:
    for name in names_of(Kind.FIELD):
        field = load_field(name)
        check_size(field, load_crop(field.crop))


def test_a_field_of_millions_of_plants_is_refused_with_what_makes_it_large() -> None:
    demo = load_field("demo")

    with pytest.raises(
        SettingsError,
        match=r"lanes 100 of length_m 2000 hold about 3933633 plants, 3333633 of crop sugar-beet .* "
        r"and 600000 weeds .* allowed is at most 400000",
    ):
        check_size(revised(demo, {"lanes": 100, "length_m": 2000}), BEET)


def test_weeds_alone_can_make_a_field_too_large() -> None:
    weedy = revised(load_field("demo"), {"lanes": 20, "length_m": 300, "weeds": {"per_m2": 60}})

    with pytest.raises(SettingsError, match=r"weeds.per_m2 60"):
        check_size(weedy, BEET)


def test_the_grass_about_a_field_counts_too() -> None:
    edge = {"present": True, "depth_m": 10, "tufts_per_m2": 400}
    edged = revised(load_field("demo"), {"lanes": 20, "length_m": 20, "grass_edge": edge})

    with pytest.raises(
        SettingsError, match=r"and \d+ tufts at grass_edge.tufts_per_m2 400; allowed is at most"
    ):
        check_size(edged, BEET)
    check_size(revised(edged, {"grass_edge": {"present": False, "tufts_per_m2": 400}}), BEET)
