"""Two runs beside each other: what moved, what is missing, what was added."""

from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.inquiry import alignment
from fieldnav.inquiry.alignment import aligned
from fieldnav.inquiry.difference import Change, Difference, Tolerance, differences
from fieldnav.journal.entry import Entry, Line, line_of

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
EXACT = Tolerance(0.0, 0.0)


def lines(entries: Sequence[Entry]) -> list[Line]:
    return [Line.model_validate(line_of(entry, number, START)) for number, entry in enumerate(entries)]


def changes(found: Sequence[Difference]) -> list[tuple[Change, str]]:
    return [(each.change, (each.before or each.after).line.event) for each in found]  # type: ignore[union-attr]


def test_a_run_differs_in_nothing_from_itself(mission: Sequence[Entry]) -> None:
    assert differences(lines(mission), lines(mission), EXACT) == []


def test_a_transition_that_came_later_has_moved(mission: Sequence[Entry]) -> None:
    later = [*mission]
    later[4] = replace(mission[4], stamp_s=20.84, forward_m=9.4)

    (moved,) = differences(lines(mission), lines(later), Tolerance(0.01, 0.1))

    assert (moved.change, moved.lane) == (Change.MOVED, 1)
    assert moved.moved_m == pytest.approx(0.4) and moved.moved_s == pytest.approx(0.8)
    assert differences(lines(mission), lines(later), Tolerance(0.5, 1.0)) == []


def test_what_only_one_of_the_runs_has_is_missing_or_added(mission: Sequence[Entry]) -> None:
    fewer = [*mission[:4], *mission[5:]]

    assert changes(differences(lines(mission), lines(fewer), EXACT)) == [(Change.MISSING, "lane ended")]
    assert changes(differences(lines(fewer), lines(mission), EXACT)) == [(Change.ADDED, "lane ended")]


def test_of_what_happened_twice_the_nearer_one_is_the_same(mission: Sequence[Entry]) -> None:
    early = replace(mission[4], stamp_s=10.0, forward_m=4.0)
    back = replace(
        mission[4], source="Forward.Exit", target="Forward.Follow.Tracking", event="rows seen again"
    )
    twice = [*mission[:4], early, replace(back, stamp_s=11.0, forward_m=4.5), *mission[4:]]

    assert changes(differences(lines(mission), lines(twice), EXACT)) == [
        (Change.ADDED, "lane ended"),
        (Change.ADDED, "rows seen again"),
    ]


def test_notes_are_no_transitions(mission: Sequence[Entry]) -> None:
    assert differences(lines(mission), lines([*mission[:3], *mission[4:]]), EXACT) == []


def test_a_lane_begins_anew_so_that_a_delay_before_it_moves_nothing_in_it(mission: Sequence[Entry]) -> None:
    second = [replace(each, lane=2, stamp_s=each.stamp_s + 30, forward_m=20.0) for each in mission[1:4]]
    delayed = [replace(each, stamp_s=each.stamp_s + 7, forward_m=23.0) for each in second]

    assert differences(lines([*mission, *second]), lines([*mission, *delayed]), EXACT) == []


def test_a_lane_that_only_one_run_reached_is_missing(mission: Sequence[Entry]) -> None:
    second = [replace(each, lane=2, stamp_s=each.stamp_s + 30) for each in mission[1:3]]

    found = differences(lines([*mission, *second]), lines(mission), EXACT)

    assert changes(found) == [(Change.MISSING, "ready"), (Change.MISSING, "rows found")]


def test_journals_that_know_no_way_are_aligned_by_what_happened(mission: Sequence[Entry]) -> None:
    older = [replace(each, forward_m=None, sideways_m=None) for each in mission]

    assert differences(lines(older), lines(older[:-1]), EXACT)[0].change is Change.MISSING


@given(st.lists(st.integers(0, 2), max_size=12), st.lists(st.integers(0, 2), max_size=12))
def test_every_transition_of_both_stands_once_and_in_order(one: list[int], other: list[int]) -> None:
    first = [Happened(("s", str(kind), "t"), float(place)) for place, kind in enumerate(one)]
    second = [Happened(("s", str(kind), "t"), 1.5 * place) for place, kind in enumerate(other)]

    for pairs in (aligned(first, second), alignment._by_what_happened(first, second)):
        assert [before for before, _ in pairs if before is not None] == first
        assert [after for _, after in pairs if after is not None] == second
        assert all(before.key == after.key for before, after in pairs if before and after)


class Happened:
    def __init__(self, key: tuple[str, str, str], way_m: float) -> None:
        self.key, self.way_m = key, way_m
