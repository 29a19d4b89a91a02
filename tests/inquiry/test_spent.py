"""Time, distance and entries of each state, from the journal's lines alone."""

from datetime import UTC, datetime

import pytest

from fieldnav.inquiry.spent import Spent, account
from fieldnav.journal.entry import Line

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)


def line(
    source: str,
    event: str,
    target: str,
    stamp_s: float,
    forward_m: float | None = 0.0,
    sideways_m: float = 0.0,
) -> Line:
    return Line(
        seq=0,
        stamp_s=stamp_s,
        utc=START,
        event=event,
        source=source,
        target=target,
        forward_m=forward_m,
        sideways_m=None if forward_m is None else sideways_m,
    )


RUN = [
    line("Idle", "start", "Checking", 0.0),
    line("Checking", "ready", "Tracking", 2.0),
    line("Tracking", "rows lost", "Coasting", 12.0, 5.0),
    line("Coasting", "rows found", "Tracking", 13.0, 5.3),
    line("Tracking", "rows lost", "Coasting", 15.0, 6.0),
    line("Coasting", "rows found", "Tracking", 15.5, 6.1),
    line("Tracking", "fail", "Fault.Recoverable", 16.0, 6.3),
]


def test_time_distance_and_entries_add_up_over_all_visits_to_a_state() -> None:
    told = account(RUN)

    assert told.states["Tracking"] == Spent(pytest.approx(12.5), pytest.approx(5.9), 3)
    assert told.states["Coasting"] == Spent(pytest.approx(1.5), pytest.approx(0.4), 2)
    assert told.states["Idle"] == Spent(0.0, 0.0, 1)
    assert told.states["Fault.Recoverable"].entries == 1
    assert told.seconds == pytest.approx(16.0)
    assert list(told.states) == ["Idle", "Checking", "Tracking", "Coasting", "Fault.Recoverable"]


def test_transitions_are_counted_and_the_last_state_is_known() -> None:
    told = account(RUN)

    assert told.made["Tracking", "rows lost", "Coasting"] == 2
    assert sum(told.made.values()) == len(RUN)
    assert told.last == "Fault.Recoverable"


def test_a_note_is_no_transition_and_no_entry() -> None:
    noted = [*RUN[:2], line("Tracking", "wall clock", "Tracking", 5.0, 1.0), *RUN[2:]]

    assert account(noted) == account(RUN)


def test_while_a_run_that_was_broken_off_did_not_run_it_was_in_no_state() -> None:
    again = [
        line("Idle", "start", "Checking", 3600.0, 6.3),
        line("Checking", "resume", "Resuming", 3601.0, 6.3),
    ]

    told = account([*RUN[:3], *again], until_s=3602.5)

    assert told.states["Idle"].entries == 2
    assert told.states["Coasting"].seconds == 0.0
    assert told.states["Checking"].seconds == pytest.approx(3.0)
    assert told.states["Resuming"].seconds == pytest.approx(1.5)
    assert told.seconds == pytest.approx(14.5)


def test_a_sidestep_counts_its_way_sideways() -> None:
    lines = [
        line("Exit", "lane left", "Crossing", 0.0, 8.0),
        line("Crossing", "rows crossed", "Settling", 10.0, 8.3, -0.4),
    ]

    assert account(lines).states["Crossing"].metres == pytest.approx(0.5)


def test_a_journal_that_tells_no_place_gives_no_distance() -> None:
    lines = [line("Idle", "start", "Checking", 0.0, None), line("Checking", "ready", "Tracking", 2.0, None)]

    assert account(lines).states["Checking"] == Spent(2.0, 0.0, 1)


def test_a_journal_without_a_line_gives_an_empty_account() -> None:
    told = account([])

    assert (dict(told.states), dict(told.made), told.last, told.seconds) == ({}, {}, "", 0)
