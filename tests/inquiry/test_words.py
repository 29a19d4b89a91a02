"""How quantities read."""

import pytest

from fieldnav.inquiry.words import decisive, judgement
from fieldnav.journal.entry import Judged


@pytest.mark.parametrize(
    ("judged", "words"),
    [
        (Judged(name="frame age", value=0.61, threshold=0.5, unit="s"), "frame age 0.61 > 0.5 s"),
        (Judged(name="rows", value=3, threshold=3), "rows 3 = 3"),
        (Judged(name="offset", value=-0.0321, threshold=0.05, unit="m"), "offset -0.0321 < 0.05 m"),
        (Judged(name="plants", value=None), "plants unknown"),
        (Judged(name="crossed", value=12345.6, unit="px"), "crossed 12346 px"),
    ],
)
def test_a_judged_quantity_reads_as_a_comparison(judged: Judged, words: str) -> None:
    assert judgement(judged) == words


def test_quantities_without_threshold_are_told_when_there_is_nothing_better() -> None:
    plain, held = Judged(name="a", value=1), Judged(name="b", value=1, threshold=2)

    assert decisive([plain, held]) == [held]
    assert decisive([plain]) == [plain]
