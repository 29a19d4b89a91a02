"""Every disturbance is on in every field unless its file says otherwise."""

import pytest

from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_field, names_of

LEAST = {
    "camera_errors": {
        "shake_deg": 1.0,
        "shake_hz": (1.0, 2.0),
        "bounce_m": 0.02,
        "tilt_error_deg": 1.5,
        "height_error_m": 0.03,
        "focal_error": 0.02,
        "yaw_error_deg": 0.3,
        "latency_s": 0.07,
        "lost_frames": 0.01,
        "exposure_s": 0.001,
        "noise": 1.0,
        "vignetting": 0.1,
        "exposure_drift": 0.05,
    },
    "wheel_errors": {"speed_error": 0.02, "steering_zero_deg": 0.5, "can_delay_s": 0.005},
    "ground": {"side_slope_deg": 2.0, "slip": 0.02},
    "light": {"sunshine": 0.5},
    "rows": {"wander_m": 0.02, "pass_error_m": 0.05, "scatter_m": 0.015, "ragged_m": 0.1},
    "start": {"offset_m": 0.01, "heading_deg": 1.0},
}


@pytest.mark.parametrize("name", names_of(Kind.FIELD))
@pytest.mark.parametrize("group", LEAST)
def test_no_shipped_field_is_spared_a_disturbance(name: str, group: str) -> None:
    field = load_field(name)

    for key, least in LEAST[group].items():
        assert getattr(getattr(field, group), key) >= least, key


@pytest.mark.parametrize("name", names_of(Kind.FIELD))
def test_in_every_shipped_field_the_wind_blows_and_the_rows_wander_over_five_metres(name: str) -> None:
    field = load_field(name)

    assert field.wind_mps >= 2
    assert field.rows.wander_length_m == 5
