"""Straight combs are found in maps of rows, wherever the camera looks."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.perception.comb.bands import BAND_COUNT, COLUMNS, LEVEL, Bands
from fieldnav.perception.comb.finder import convergence_of
from fieldnav.perception.comb.row_comb import straight
from fieldnav.perception.comb.straight_search import straight_combs


@pytest.mark.parametrize(
    ("convergence", "across", "vanishing"),
    [(0.1, 2.2, 0.0), (0.4, 4.3, 0.3), (1.2, 6.0, -0.5), (1.7, 3.1, 0.1)],
)
def test_the_comb_that_was_drawn_is_found(
    teeth: SimpleNamespace, convergence: float, across: float, vanishing: float
) -> None:
    drawn = straight(convergence, across, vanishing)
    bands = Bands(teeth.bands(drawn, noise=0.2).strength, evenness=0.0)

    best = straight_combs(bands)[0]

    spacing = 1 / float(np.interp(0.0, LEVEL, best.comb.spacing))
    assert spacing == pytest.approx(across, rel=0.03)
    assert convergence_of(best.comb) == pytest.approx(convergence, abs=0.1)
    near = LEVEL > 0
    off = ((best.comb.middle - drawn.middle) / drawn.spacing)[near]
    assert np.abs(off - np.round(off)).max() < 0.1


def test_an_empty_map_has_no_comb() -> None:
    assert straight_combs(Bands(np.zeros((BAND_COUNT, COLUMNS), np.float32))) == []


def test_the_best_comb_comes_first(teeth: SimpleNamespace) -> None:
    found = straight_combs(Bands(teeth.bands(teeth.oblique, noise=0.3).strength, evenness=0.0))

    assert [each.response for each in found] == sorted((each.response for each in found), reverse=True)
