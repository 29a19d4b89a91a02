"""The coarse search finds the comb that was drawn, whatever its direction, spacing and perspective."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.perception.comb.bands import BAND_COUNT, COLUMNS, LEVEL, Bands
from fieldnav.perception.comb.periodogram import candidates
from fieldnav.perception.comb.row_comb import straight
from fieldnav.perception.comb.search_range import any_camera


@settings(deadline=None, max_examples=12)
@given(st.floats(0.25, 0.6), st.floats(2.5, 12), st.floats(-0.3, 0.3))
def test_the_best_candidate_lies_near_the_drawn_comb(
    teeth: SimpleNamespace, convergence: float, rows_across: float, vanishing: float
) -> None:
    true = straight(convergence, rows_across, vanishing)

    found = candidates(teeth.bands(true, noise=0.2), any_camera(None))

    middle = [float(1 / np.interp(0, LEVEL, comb.spacing)) for comb in found]
    assert middle[0] == pytest.approx(rows_across, rel=0.06)
    assert found[0].response(teeth.bands(true)) > 0.4


def test_candidates_come_best_first(teeth: SimpleNamespace) -> None:
    bands = teeth.bands(teeth.oblique, noise=0.3)

    response = [comb.response(bands) for comb in candidates(bands, any_camera(None))]

    assert response == sorted(response, reverse=True)


def test_without_vegetation_there_is_no_candidate() -> None:
    assert candidates(Bands(np.zeros((BAND_COUNT, COLUMNS), np.float32)), any_camera(None)) == ()
