"""Combs: they run as a plane under a camera says, and respond to the rows that are there."""

from math import radians
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.perception.comb.bands import LEVEL, Bands
from fieldnav.perception.comb.row_comb import RowComb, straight
from fieldnav.pinhole import Pinhole


@settings(deadline=None, max_examples=30)
@given(st.floats(50, 75), st.floats(-0.15, 0.15), st.floats(0.8, 2.0))
def test_rows_on_the_ground_are_a_comb_in_the_picture(tilt_deg: float, slope: float, height_m: float) -> None:
    camera, spacing_m = Pinhole(1280, 720, 930.0, height_m, radians(tilt_deg), 0.0), 0.35
    convergence = camera.height_px / (camera.focal_px * np.tan(camera.tilt_rad))
    across = camera.width_px / float(camera.pixels_per_metre(camera.centre_y_px)) / spacing_m
    vanishing = -slope * camera.focal_px / (camera.width_px * np.cos(camera.tilt_rad))
    comb = straight(convergence, across, vanishing)

    row = camera.row_in_image(0.0, slope)
    next_row = camera.row_in_image(-spacing_m, slope)
    at = LEVEL + 0.5
    place = (row.x_top_px + (row.x_bottom_px - row.x_top_px) * at - camera.centre_x_px) / camera.width_px
    other = (
        next_row.x_top_px + (next_row.x_bottom_px - next_row.x_top_px) * at - camera.centre_x_px
    ) / camera.width_px

    assert other - place == pytest.approx(comb.spacing, rel=0.01)
    assert np.diff(place) == pytest.approx(np.diff(comb.middle), abs=1e-3)


@pytest.mark.parametrize("name", ["steep", "oblique"])
def test_a_comb_responds_to_its_own_rows_and_hardly_to_others(teeth: SimpleNamespace, name: str) -> None:
    comb = getattr(teeth, name)
    bands = teeth.bands(comb)
    beside = straight(0.4, 3.1, -0.2)

    assert comb.response(bands) > 0.8
    assert comb.weakest_response(bands) > 0.7
    assert abs(beside.response(bands)) < 0.2


@settings(deadline=None, max_examples=20)
@given(st.floats(-0.5, 0.5))
def test_a_comb_is_brought_into_phase(teeth: SimpleNamespace, shift: float) -> None:
    comb = teeth.steep
    moved = RowComb(comb.middle + shift * comb.spacing, comb.spacing, comb.usable)

    found = moved.in_phase(teeth.bands(comb))

    off = (found.middle - comb.middle) / comb.spacing
    assert np.abs(off - np.round(off)).max() < 0.02


def test_a_row_that_fades_half_way_shows_in_the_weakest_stretches(teeth: SimpleNamespace) -> None:
    strength = teeth.bands(teeth.steep).strength.copy()
    strength[: len(strength) // 2] = 0
    bands = Bands(strength)

    assert teeth.steep.response(bands) > 0.8
    assert teeth.steep.weakest_response(bands) < 0.05


def test_near_the_horizon_rows_cannot_be_told_apart() -> None:
    comb = straight(2.1, 20.0, 0.0)

    assert not comb.usable[0]
    assert comb.usable[-1]


def test_rows_are_numbered_from_left_to_right_where_they_can_be_seen(teeth: SimpleNamespace) -> None:
    comb = teeth.steep
    places = comb.middle + comb.numbers[:, None] * comb.spacing

    assert comb.numbers.tolist() == sorted(comb.numbers.tolist())
    assert (np.abs(places) < 0.5).any(axis=1).all()
    assert len(comb.numbers) >= 4
