"""Single rows of a comb: displaced ones are found where they are, missing ones told from standing ones."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.perception.comb.bands import Bands
from fieldnav.perception.comb.confidence import confidence_of
from fieldnav.perception.comb.row_comb import RowComb, straight
from fieldnav.perception.comb.rows import rows_of

SCATTER = 0.25


def test_a_row_sown_beside_its_place_is_found_there(teeth: SimpleNamespace) -> None:
    comb = teeth.steep
    only = int(comb.numbers[len(comb.numbers) // 2])
    others = tuple(number for number in comb.numbers.tolist() if number != only)
    beside = RowComb(comb.middle + 0.1 * comb.spacing, comb.spacing, comb.usable)
    strength = teeth.bands(comb, without=(only,)).strength + teeth.bands(beside, without=others).strength

    rows = rows_of(comb, Bands(strength.clip(0, 1)), SCATTER)

    place = ((rows.place - comb.middle) / comb.spacing).mean(axis=1)
    off = place - np.round(place)
    assert off[np.round(place) == only] == pytest.approx([0.09], abs=0.02)
    assert off[np.round(place) != only] == pytest.approx(0, abs=0.02)


def test_a_missing_row_is_not_believed_and_its_neighbours_are(teeth: SimpleNamespace) -> None:
    comb = teeth.steep
    missing = int(comb.numbers[len(comb.numbers) // 2])
    bands = teeth.bands(comb, without=(missing,))

    rows = rows_of(comb, bands, SCATTER)
    sure = confidence_of(rows, comb, bands)

    number = np.round(((rows.place - comb.middle) / comb.spacing).mean(axis=1))
    assert sure[number == missing] == pytest.approx([0], abs=0.1)
    assert sure[number != missing].min() > 0.9


def test_rows_in_noise_are_not_believed(teeth: SimpleNamespace) -> None:
    noise = Bands(np.random.default_rng(3).random(teeth.bands(teeth.steep).strength.shape, np.float32))
    comb = teeth.steep.in_phase(noise)

    assert confidence_of(rows_of(comb, noise, SCATTER), comb, noise).max() < 0.1


def test_a_row_along_only_half_its_length_is_less_even(teeth: SimpleNamespace) -> None:
    strength = teeth.bands(teeth.steep).strength.copy()
    strength[:24, 160:] = 0

    whole = rows_of(teeth.steep, teeth.bands(teeth.steep), SCATTER)
    half = rows_of(teeth.steep, Bands(strength), SCATTER)

    middle = len(whole) // 2
    assert half.evenness[middle + 1] < 0.6
    assert whole.evenness[middle + 1] > 0.95
    assert half.evenness[middle - 1] > 0.95


def test_a_row_that_leaves_the_picture_half_way_is_left_out(teeth: SimpleNamespace) -> None:
    leaving = straight(0.4, 4.05, 0.0)

    rows = rows_of(leaving, teeth.bands(leaving), SCATTER)

    assert len(rows) < len(leaving.numbers)
    assert ((np.abs(rows.place) < 0.5).mean(axis=1) >= 0.55).all()
