"""Pictures of vegetation strength drawn as exact combs, at the size of the bands."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.perception.comb.bands import BAND_COUNT, COLUMNS, Bands
from fieldnav.perception.comb.row_comb import RowComb, straight


def drawn_comb(
    comb: RowComb, width: float = 0.08, noise: float = 0.0, without: tuple[int, ...] = (), seed: int = 1
) -> Bands:
    """Bands on which vegetation stands along the comb's rows, as wide as a share of their spacing."""
    column = (np.arange(COLUMNS) + 0.5) / COLUMNS - 0.5
    strength = (
        np.random.default_rng(seed).uniform(0, noise, (BAND_COUNT, COLUMNS))
        if noise
        else np.zeros((BAND_COUNT, COLUMNS))
    )
    for number in set(comb.numbers.tolist()) - set(without):
        off = (column - (comb.middle + number * comb.spacing)[:, None]) / comb.spacing[:, None]
        strength = strength + np.exp(-0.5 * (off / width) ** 2) * comb.usable[:, None]
    return Bands(strength.clip(0, 1).astype(np.float32))


@pytest.fixture(scope="session")
def teeth() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    return SimpleNamespace(
        bands=drawn_comb, steep=straight(0.4, 4.3, 0.05), oblique=straight(1.6, 5.2, -0.08)
    )
