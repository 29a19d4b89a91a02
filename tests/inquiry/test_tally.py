"""What a journal adds up to."""

from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime

import pytest

from fieldnav.inquiry.tally import LaneTally, tally
from fieldnav.journal.entry import Entry, Line, line_of

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)


def lines(entries: Sequence[Entry]) -> list[Line]:
    return [Line.model_validate(line_of(entry, number, START)) for number, entry in enumerate(entries)]


def test_transitions_coastings_holds_and_stops_are_counted_in_their_lane(mission: Sequence[Entry]) -> None:
    second = [replace(each, lane=2) for each in mission[2:5]]

    made = tally(lines([*mission, *second]))

    assert made.lanes[1] == LaneTally(transitions=6, coastings=1, holds=1, stops=1)
    assert made.lanes[2] == LaneTally(transitions=2, coastings=0, holds=1, stops=0)


def test_each_condition_that_made_an_event_gives_its_margin(mission: Sequence[Entry]) -> None:
    made = tally(lines([*mission, mission[4]]))

    assert made.margins["lane ended", "probability of an end", ""] == pytest.approx([0.02, 0.02])
    assert made.margins["fail", "coasted", "m"] == pytest.approx([0.1])


def test_stops_and_holds_are_counted_by_the_fault_that_they_name(mission: Sequence[Entry]) -> None:
    latched = Entry(40.0, "latch", "Forward.Exit", "Fault.Latched", 1, reason="steering stuck: module")

    made = tally(lines([*mission, latched]))

    assert made.faults == {"steering stuck": 1, "no fault named": 1}
    assert made.holds == {"camera black": 1}
