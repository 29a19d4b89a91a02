"""The moving variance is that of the angles within half the neighbours on either side."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fieldnav.perception.moving_variance import moving_variance


@given(
    arrays(np.float64, st.integers(1, 40), elements=st.floats(-60, 60) | st.just(np.nan)), st.integers(2, 100)
)
def test_it_is_the_variance_of_the_places_around_however_few_there_are(
    angle: np.ndarray[tuple[int], np.dtype[np.float64]], neighbours: int
) -> None:
    variance = moving_variance(angle, neighbours)

    half = neighbours // 2
    for place, value in enumerate(angle):
        around = angle[max(0, place - half) : place + half + 1]
        known = around[np.isfinite(around)]
        expected = np.nan if np.isnan(value) else known.var()
        assert variance[place] == pytest.approx(expected, abs=1e-6, nan_ok=True)
