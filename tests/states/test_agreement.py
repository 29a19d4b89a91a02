"""A lane needs several looks that agree."""

from types import SimpleNamespace

import pytest

from fieldnav.perception.lane import LaneFit
from states.agreement import OFFSET_M, SLOPE, Agreement


def fit(offset_m: float = 0.0, slope: float = 0.0) -> LaneFit:
    return LaneFit((), offset_m, slope, 3, 0.35, 0.0)


def test_looks_that_agree_are_counted_and_then_believed() -> None:
    agreement = Agreement(3)

    words = [agreement.add(fit(offset_m=0.01 * look)) for look in range(5)]

    assert words == [False, False, True, True, True]
    assert agreement.evidence()[0].value == 5


@pytest.mark.parametrize("other", [None, fit(offset_m=OFFSET_M * 1.1), fit(slope=-SLOPE * 1.1)])
def test_a_look_that_disagrees_begins_anew(other: LaneFit | None, drawn: SimpleNamespace) -> None:
    agreement = Agreement(3)
    agreement.add(fit())
    agreement.add(fit())

    assert not agreement.add(other)
    assert not agreement.add(fit())
    assert agreement.looks == 1
