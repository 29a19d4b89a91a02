"""Single rows of a comb: displaced ones are found where they are, missing ones told from standing ones."""

from types import SimpleNamespace

import numpy as np
import pytest
from fieldnav.perception.comb.bands import Bands
from fieldnav.perception.comb.confidence import confidence_of
from fieldnav.perception.comb.row_comb import RowComb
from fieldnav.perception.comb.rows import rows_of


def test_a_row_sown_beside_its_place_is_found_there(teeth: SimpleNamespace) -> None:
    comb = teeth.steep
    only = int(comb.numbers[len(comb.numbers) // 2])
    others = tuple(number for number in comb.numbers.tolist() if number != only)
    beside = RowComb(comb.middle + 0.1 * comb.spacing, comb.spacing, comb.usable)
    strength = teeth.bands(comb, without=(only,)).strength + teeth.bands(beside, without=others).strength

    rows = rows_of(comb, Bands(strength.clip(0, 1)))

    place = ((rows.place - comb.middle) / comb.spacing).mean(axis=1)
    off = place - np.round(place)
    assert off[np.round(place) == only] == pytest.approx([0.1], abs=0.03)
    assert off[np.round(place) != only] == pytest.approx(0, abs=0.02)


def test_a_missing_row_is_not_believed_and_its_neighbours_are(teeth: SimpleNamespace) -> None:
    comb = teeth.steep
    missing = int(comb.numbers[len(comb.numbers) // 2])
    bands = teeth.bands(comb, without=(missing,))

    rows = rows_of(comb, bands)
    sure = confidence_of(rows, comb, bands)

    number = np.round(((rows.place - comb.middle) / comb.spacing).mean(axis=1))
    assert sure[number == missing] == pytest.approx([0], abs=0.1)
    assert sure[number != missing].min() > 0.9


def test_rows_in_noise_are_not_believed(teeth: SimpleNamespace) -> None:
    noise = Bands(np.random.default_rng(3).random(teeth.bands(teeth.steep).strength.shape, np.float32))
    comb = teeth.steep.in_phase(noise)

    assert confidence_of(rows_of(comb, noise), comb, noise).max() < 0.1


def test_a_row_along_only_half_its_length_is_less_even(teeth: SimpleNamespace) -> None:
    strength = teeth.bands(teeth.steep).strength.copy()
    strength[:24, 160:] = 0

    rows = rows_of(teeth.steep, Bands(strength))

    assert rows.evenness[0] > 0.95
    assert rows.evenness[-1] < 0.7


def test_a_row_that_hardly_enters_the_picture_is_left_out(teeth: SimpleNamespace) -> None:
    rows = rows_of(teeth.steep, teeth.bands(teeth.steep))

    assert ((np.abs(rows.place) < 0.5).mean(axis=1) >= 0.55).all()
    assert len(rows) < len(teeth.steep.numbers)
