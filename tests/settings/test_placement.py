"""Gaps and unsown rows that a field file places must be in the field."""

import pytest

from fieldnav.errors import SettingsError
from fieldnav.messages import Side
from fieldnav.settings.fit import check_size
from fieldnav.settings.loading import load_crop, load_field, revised
from fieldnav.simulation.plan import sow

BEET = load_crop("sugar-beet")
CASES = {
    "a gap in a lane too many": (
        {"gaps": {"placed": [{"lane": 4, "start_m": 2, "length_m": 1}]}},
        "gaps.placed.0.lane: 4 is not allowed; allowed is a whole number from 1 to 3, the field's lanes",
    ),
    "a gap in a row too many": (
        {"gaps": {"placed": [{"lane": 1, "row": 4, "start_m": 2, "length_m": 1}]}},
        "gaps.placed.0.row: 4 is not allowed; allowed is a whole number from 1 to 3, the rows.per_lane "
        "of crop sugar-beet",
    ),
    "a gap past the end": (
        {"gaps": {"placed": [{"lane": 1, "start_m": 10, "length_m": 3}]}},
        "gaps.placed.0: start_m 10 with length_m 3 is not allowed; allowed is a gap that ends within the "
        "field's length_m 12",
    ),
    "a lane unsown too many": (
        {"unsown": {"lanes": [2, 5]}},
        "unsown.lanes.1: 5 is not allowed; allowed is a whole number from 1 to 3, the field's lanes",
    ),
    "a row unsown too many": (
        {"unsown": {"rows": [{"lane": 2, "row": 5}]}},
        "unsown.rows.0.row: 5 is not allowed; allowed is a whole number from 1 to 3, the rows.per_lane "
        "of crop sugar-beet",
    ),
    "a row unsown in a lane too many": (
        {"unsown": {"rows": [{"lane": 9, "row": 1}]}},
        "unsown.rows.0.lane: 9 is not allowed; allowed is a whole number from 1 to 3, the field's lanes",
    ),
    "the first lane unsown": (
        {"unsown": {"lanes": [1]}},
        "unsown: lane 1 is not allowed; allowed are lanes from 2 on: the robot is set down at the first",
    ),
    "the first lane unsown row by row": (
        {"unsown": {"rows": [{"lane": 1, "row": row} for row in (1, 2, 3)]}},
        "unsown: lane 1 is not allowed; allowed are lanes from 2 on: the robot is set down at the first",
    ),
}


@pytest.mark.parametrize(("changes", "problem"), CASES.values(), ids=CASES)
def test_what_is_not_in_the_field_is_refused_in_one_line(changes: dict[str, object], problem: str) -> None:
    field = revised(load_field("demo"), changes)

    for check in (lambda: check_size(field, BEET), lambda: sow(field, BEET, Side.RIGHT)):
        with pytest.raises(SettingsError) as caught:
            check()
        assert str(caught.value) == f"field demo: {problem}"


@pytest.mark.parametrize(
    ("gap", "problem"),
    [
        (
            {"lane": 0, "start_m": 2, "length_m": 1},
            "lane: 0 is not allowed; allowed is a whole number from 1 to 100",
        ),
        (
            {"lane": 1, "row": -1, "start_m": 2, "length_m": 1},
            "row: -1 is not allowed; allowed is a whole number from 0 to 20 (the lane's rightmost row is 1; "
            "0 or left out: all rows)",
        ),
        ({"lane": 1, "start_m": 2}, "length_m: is missing; allowed is a number from 0.05 to 2000"),
    ],
)
def test_a_gap_with_a_wrong_value_is_refused_by_its_key(gap: dict[str, float], problem: str) -> None:
    with pytest.raises(SettingsError) as caught:
        revised(load_field("demo"), {"gaps": {"placed": [gap]}})

    assert str(caught.value) == f"options: gaps.placed.0.{problem}"


def test_a_gap_may_fill_a_row_from_end_to_end() -> None:
    gap = {"lane": 2, "row": 3, "start_m": 0, "length_m": 12}

    plan = sow(revised(load_field("demo"), {"gaps": {"placed": [gap]}}), BEET, Side.RIGHT)

    assert plan.sown.tolist() == [[True] * 3, [True, True, False], [True] * 3]
