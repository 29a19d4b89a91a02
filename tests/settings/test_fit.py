"""Rows and wheels must not share the ground."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fieldnav.errors import SettingsError
from fieldnav.settings.fit import check_fit
from fieldnav.settings.loading import load_crop, load_robot

BEET, BONNBOT = load_crop("sugar-beet"), load_robot("bonnbot")


def test_rows_that_reach_under_the_wheels_are_refused() -> None:
    wide = BEET.model_copy(update={"rows": BEET.rows.model_copy(update={"per_lane": 4})})

    with pytest.raises(SettingsError, match=r"rows.per_lane 4 .* reach 0.625 m .* at most 0.620 m"):
        check_fit(
            wide.model_copy(update={"plants": BEET.plants.model_copy(update={"canopy_width_m": 0.2})}),
            BONNBOT,
        )


def test_a_canopy_higher_than_the_robot_is_refused() -> None:
    low = BONNBOT.model_copy(update={"geometry": BONNBOT.geometry.model_copy(update={"clearance_m": 0.1})})

    with pytest.raises(SettingsError, match=r"canopy_height_m 0.12; allowed is at most the clearance, 0.1 m"):
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
