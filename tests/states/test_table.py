"""What must hold over the whole table of states, whatever is added to it."""

from enum import Enum

import pytest

from fieldnav.messages import Direction
from states.machine import RESUMABLE, SEPARATOR, MissionMachine
from states.names import Event, Fault, Follow, Path, Phase, Sidestep, Top, text
from states.table import (
    CHECKING,
    FINISHED,
    IDLE,
    LANE_LEAVES,
    LATCHED,
    LEAVES,
    PAUSED,
    RECOVERABLE,
    RESUMING,
    TRANSITIONS,
)

NAMES: tuple[type[Enum], ...] = (Top, Direction, Phase, Follow, Sidestep, Fault)


def within(leaf: Path, source: Path) -> bool:
    return leaf[: len(source)] == source


def targets(leaf: Path) -> set[Path]:
    """Every leaf that one event leads to; a resume leads back to all that can be interrupted."""
    found: set[Path] = set()
    for row in TRANSITIONS:
        if within(leaf, row.source):
            found |= set(RESUMABLE) if row.target is None else {row.target}
    return found


def reachable_from(start: Path) -> set[Path]:
    seen, waiting = {start}, [start]
    while waiting:
        new = targets(waiting.pop()) - seen
        seen |= new
        waiting += new
    return seen


def events_to(leaf: Path, target: Path) -> set[Event]:
    return {row.event for row in TRANSITIONS if within(leaf, row.source) and row.target == target}


@pytest.mark.parametrize("leaf", LANE_LEAVES, ids=text)
def test_every_moving_state_can_be_paused_and_can_fail(leaf: Path) -> None:
    assert events_to(leaf, PAUSED) == {Event.PAUSE}
    assert events_to(leaf, RECOVERABLE) == {Event.FAIL}
    assert events_to(leaf, LATCHED) == {Event.LATCH}


@pytest.mark.parametrize("leaf", LEAVES, ids=text)
def test_every_state_can_be_reached_from_the_first(leaf: Path) -> None:
    assert leaf in reachable_from(IDLE)


@pytest.mark.parametrize("leaf", LEAVES, ids=text)
def test_no_state_is_without_a_way_out_and_the_end_can_be_reached(leaf: Path) -> None:
    assert targets(leaf) - {leaf}
    assert FINISHED in reachable_from(leaf)
    assert IDLE in reachable_from(leaf)


def test_both_directions_of_travel_have_the_same_states_and_transitions() -> None:
    def mirrored(path: Path | None) -> Path | None:
        if path is None or not isinstance(path[0], Direction):
            return path
        return (path[0].opposite, *path[1:])

    rows = [row for row in TRANSITIONS if isinstance(row.source[0], Direction)]
    seen = {(row.source, row.event, row.target) for row in rows}
    assert {(mirrored(source), event, mirrored(target)) for source, event, target in seen} == seen
    assert {mirrored(leaf) for leaf in LANE_LEAVES} == set(LANE_LEAVES)


def test_only_states_of_the_table_are_sources_and_targets() -> None:
    for row in TRANSITIONS:
        assert any(within(leaf, row.source) for leaf in LEAVES), row
        assert row.target is None or row.target in LEAVES, row


def test_one_event_leads_to_one_state_only() -> None:
    for leaf in LEAVES:
        events = [row.event for row in TRANSITIONS if within(leaf, row.source)]
        assert len(events) == len(set(events)), text(leaf)


@pytest.mark.parametrize("names", [*NAMES, Event], ids=lambda names: names.__name__)
def test_no_name_holds_what_separates_nested_names(names: type[Enum]) -> None:
    for member in names:
        assert SEPARATOR not in str(member.value)
        assert "." not in str(member.value), "the journal joins names with it"


def test_what_may_be_resumed_are_the_check_and_the_moving_states() -> None:
    assert set(RESUMABLE) == {CHECKING, RESUMING, *LANE_LEAVES}
    assert MissionMachine().leaf == IDLE
