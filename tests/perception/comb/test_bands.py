"""Bands and their spectra: what goes in comes out at the right frequency, phase and place."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.perception.comb.bands import BAND_COUNT, COLUMNS, Bands, bands_of


@settings(deadline=None, max_examples=30)
@given(st.floats(1.5, 60), st.floats(0, 1))
def test_a_wave_is_found_at_its_frequency_and_in_its_phase(cycles: float, turn: float) -> None:
    place = (np.arange(COLUMNS) - (COLUMNS - 1) / 2) / COLUMNS
    wave = 0.5 + 0.4 * np.cos(2 * np.pi * (cycles * place - turn))
    bands = Bands(np.tile(wave, (BAND_COUNT, 1)).astype(np.float32))

    value = bands.at(np.full((BAND_COUNT, 1), cycles))[0, 0]
    direct = (bands.even[0] * np.exp(-2j * np.pi * cycles * place)).sum()

    assert abs(value - direct) < 0.02 * abs(direct)


def test_beyond_its_finest_frequency_a_spectrum_is_zero() -> None:
    bands = Bands(np.random.default_rng(1).random((BAND_COUNT, COLUMNS), np.float32))

    assert not bands.at(np.full((BAND_COUNT, 1), COLUMNS / 2 + 1)).any()


def test_samples_lie_between_their_columns_and_outside_there_is_nothing() -> None:
    ramp = np.tile(np.arange(COLUMNS) / COLUMNS, (BAND_COUNT, 1)).astype(np.float32)

    value, inside = Bands(ramp).sample(np.tile([-0.6, -0.25, 0.0, 0.25, 0.6], (BAND_COUNT, 1)))

    assert value[7] == pytest.approx(
        [0, 0.25 - 0.5 / COLUMNS, 0.5 - 0.5 / COLUMNS, 0.75 - 0.5 / COLUMNS, 0], abs=1e-5
    )
    assert inside[7].tolist() == [False, True, True, True, False]


@pytest.mark.parametrize("grey", [0, 128, 255])
def test_a_picture_of_one_shade_is_empty(grey: int) -> None:
    assert bands_of(np.full((90, 160), grey, np.uint8)).empty


def test_near_and_far_plants_count_alike() -> None:
    strength = np.zeros((BAND_COUNT, COLUMNS), np.float32)
    strength[:24, 100:104] = 1.0
    strength[24:, 100:132] = 1.0

    span = Bands(strength).span

    assert span[30] / span[10] < 1.5
