"""A comb that starts a little off is drawn onto the rows, also where they bend."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.perception.comb.bands import LEVEL
from fieldnav.perception.comb.finder import OBLIQUE_VIEW, STEEP_VIEW
from fieldnav.perception.comb.refinement import off_centre, refine, teeth_of
from fieldnav.perception.comb.row_comb import RowComb, straight


@settings(deadline=None, max_examples=15)
@given(st.floats(-0.12, 0.12), st.floats(-0.03, 0.03), st.floats(-0.06, 0.06))
def test_a_steep_comb_is_drawn_onto_its_rows(
    teeth: SimpleNamespace, shift: float, turn: float, wider: float
) -> None:
    true = teeth.steep
    start = straight(0.4, 4.3 * (1 + wider), 0.05 + turn)
    start = RowComb(start.middle + shift * true.spacing, start.spacing, start.usable)

    found = refine(start, teeth.bands(true), STEEP_VIEW)

    assert found.middle / true.spacing == pytest.approx(true.middle / true.spacing, abs=0.04)
    assert found.spacing == pytest.approx(true.spacing, rel=0.03)


def test_an_oblique_comb_bends_with_its_rows(teeth: SimpleNamespace) -> None:
    true = straight(1.6, 5.2, -0.08, bend=0.06)
    comb = straight(1.6, 5.3, -0.08)

    for stiffness in OBLIQUE_VIEW:
        comb = refine(comb, teeth.bands(true), stiffness)

    near = LEVEL > -0.3
    assert (comb.middle / true.spacing)[near] == pytest.approx((true.middle / true.spacing)[near], abs=0.1)


def test_what_stands_beside_a_tooth_is_measured_in_spacings(teeth: SimpleNamespace) -> None:
    comb = teeth.steep
    off, weight = off_centre(
        teeth_of(RowComb(comb.middle - 0.1 * comb.spacing, comb.spacing, comb.usable), teeth.bands(comb)),
        0.15,
    )

    assert np.average(off, weights=weight) == pytest.approx(0.1, abs=0.04)


def test_lush_plants_count_little_more_than_ordinary_ones(teeth: SimpleNamespace) -> None:
    bands = teeth.bands(teeth.steep)
    faint = bands.strength.copy()
    faint[::2] *= 0.3

    _, weight = off_centre(teeth_of(teeth.steep, type(bands)(faint)), 0.15)

    seen = weight[:, 10:40].max(axis=0)
    assert seen[1] / seen[0] < 2
