"""What speaks against a lane is said in words, the gravest first."""

from math import nan

import pytest

from fieldnav.messages import Bound, Evidence
from states.verdict import _objection


def evidence(
    shown: int = 3, off_m: float = 0.0, uneven: float = 0.0, beside: int = 0
) -> tuple[Evidence, ...]:
    return (
        Evidence("frame shows the lane as expected", 0.0, 1),
        Evidence("rows that a fresh look shows", 3, 3, "rows"),
        Evidence("rows that show plants where they should", shown, 3, "rows"),
        Evidence("its lane lies off by", off_m, 0.1, "m", bound=Bound.AT_MOST),
        Evidence("its row spacing is off by the share", uneven, 0.2, bound=Bound.AT_MOST),
        Evidence("rows where the wheels will go", beside, 0, "rows", bound=Bound.AT_MOST),
    )


@pytest.mark.parametrize(
    ("found", "said"),
    [
        (evidence(beside=1, off_m=0.3), "a row stands where the wheels will go"),
        (evidence(beside=2), "2 rows stand where the wheels will go"),
        (evidence(off_m=0.14, uneven=0.5), "its lane lies off by 0.14 m, at most 0.10"),
        (evidence(uneven=0.24, shown=1), "its row spacing is off by the share 0.24, at most 0.20"),
        (evidence(shown=1, off_m=nan, uneven=nan), "1 of 3 rows show plants where they should"),
    ],
)
def test_the_gravest_objection_is_named(found: tuple[Evidence, ...], said: str) -> None:
    assert _objection(found) == said
