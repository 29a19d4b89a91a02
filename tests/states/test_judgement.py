"""An event comes about by the conditions that the evidence names."""

import pytest

from fieldnav.messages import Bound, Evidence
from states.judgement import comes_about, first_of
from states.names import Event


@pytest.mark.parametrize(
    ("values", "comes"),
    [((1, 1, 0), True), ((1, 0, 0), False), ((0, 0, 1), True), ((1, 1, 1), True), ((0, 0, 0), False)],
)
def test_an_event_wants_all_of_its_conditions_or_one_that_is_enough_alone(
    values: tuple[int, int, int], comes: bool
) -> None:
    alone = (False, False, True)
    evidence = [
        Evidence(str(index), value, 1, "", Event.FAIL, alone=by_itself)
        for index, (value, by_itself) in enumerate(zip(values, alone, strict=True))
    ]

    assert comes_about(evidence, Event.FAIL) is comes
    assert not comes_about(evidence, Event.ROWS_FOUND), "it has no condition here"
    assert first_of(evidence, Event.ROWS_FOUND, Event.FAIL) is (Event.FAIL if comes else None)


def test_a_quantity_that_is_no_number_fulfils_no_condition() -> None:
    for bound in Bound:
        assert not comes_about([Evidence("x", float("nan"), 1.0, "", Event.FAIL, bound)], Event.FAIL)
