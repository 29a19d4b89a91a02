"""The machine at work: the way of a mission, interruptions and resets."""

import pytest
from transitions import MachineError

from fieldnav.messages import Direction
from states.machine import MissionMachine
from states.names import Event, Follow, Path, Phase, Sidestep, text
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

TO_FOLLOW = (Event.ROWS_FOUND,)
TO_EXIT = (*TO_FOLLOW, Event.LANE_ENDED)
TO_NEXT_LANE = (
    *TO_EXIT,
    Event.LANE_LEFT,
    Event.WHEELS_TURNED,
    Event.ROW_SAMPLED,
    Event.ROWS_CROSSED,
    Event.LANE_REACHED,
    Event.LANE_VERIFIED,
    Event.LANE_CENTRED,
)
EXPECTED = (Direction.BACKWARD, Phase.EXIT)
"""Where a mission that was broken off is to go on."""
STARTED = (Event.START, Event.READY)


def driven(*events: Event) -> MissionMachine:
    machine = MissionMachine()
    for event in events:
        machine.fire(event)
    return machine


def at(leaf: Path) -> MissionMachine:
    """A machine brought to a state by the table's shortest way."""
    ways: dict[Path, tuple[Event, ...]] = {IDLE: ()}
    waiting = [IDLE]
    while leaf not in ways:
        here = waiting.pop(0)
        for row in TRANSITIONS:
            if here[: len(row.source)] == row.source and row.target and row.target not in ways:
                ways[row.target] = (*ways[here], row.event)
                waiting.append(row.target)
    machine = driven(*ways[leaf])
    assert machine.leaf == leaf
    return machine


def test_a_mission_of_three_lanes_goes_forward_backward_forward_and_finishes() -> None:
    machine = driven(*STARTED)
    directions = []
    for events in (TO_NEXT_LANE, TO_NEXT_LANE, (*TO_EXIT, Event.LAST_LANE_LEFT)):
        directions.append(machine.leaf[0])
        for event in events:
            machine.fire(event)

    assert directions == [Direction.FORWARD, Direction.BACKWARD, Direction.FORWARD]
    assert machine.leaf == FINISHED


@pytest.mark.parametrize("leaf", LANE_LEAVES, ids=text)
@pytest.mark.parametrize("interruption", [Event.PAUSE, Event.FAIL], ids=lambda event: event.value)
def test_an_interrupted_state_is_resumed_where_it_was(leaf: Path, interruption: Event) -> None:
    machine = at(leaf)

    machine.fire(interruption)
    change = machine.fire(Event.RESUME)

    assert machine.leaf == change.target == leaf


def test_a_fault_during_a_pause_still_resumes_where_the_mission_was() -> None:
    leaf = (Direction.FORWARD, Phase.SIDESTEP, Sidestep.CROSSING)
    machine = at(leaf)

    machine.fire(Event.PAUSE)
    machine.fire(Event.FAIL)
    assert machine.leaf == RECOVERABLE
    machine.fire(Event.RESUME)

    assert machine.leaf == leaf


@pytest.mark.parametrize("leaf", [CHECKING, PAUSED, RECOVERABLE, *LANE_LEAVES], ids=text)
def test_a_latched_fault_lets_nothing_happen_but_a_reset(leaf: Path) -> None:
    machine = at(leaf)
    machine.fire(Event.LATCH)

    assert machine.leaf == LATCHED
    assert [event for event in Event if machine.may(event)] == [Event.RESET]
    machine.fire(Event.RESET)
    assert machine.leaf == IDLE


def test_a_reset_forgets_where_the_mission_was_interrupted() -> None:
    machine = driven(*STARTED, *TO_FOLLOW, Event.PAUSE, Event.RESET, Event.START, Event.PAUSE, Event.RESUME)

    assert machine.leaf == CHECKING


def test_after_a_resume_the_next_interruption_counts() -> None:
    machine = driven(*STARTED, Event.PAUSE, Event.RESUME, *TO_FOLLOW, Event.FAIL, Event.RESUME)

    assert machine.leaf == (Direction.FORWARD, Phase.FOLLOW, Follow.TRACKING)


@pytest.mark.parametrize("leaf", LEAVES, ids=text)
@pytest.mark.parametrize("event", Event, ids=lambda event: event.value)
def test_the_machine_does_what_the_table_says_and_refuses_the_rest(leaf: Path, event: Event) -> None:
    machine = at(leaf)
    rows = [row for row in TRANSITIONS if leaf[: len(row.source)] == row.source and row.event is event]

    if not rows:
        assert not machine.may(event)
        with pytest.raises(MachineError):
            machine.fire(event)
        return
    machine.expected = EXPECTED
    change = machine.fire(event)
    assert (change.source, change.event) == (leaf, event)
    # The shortest way into a pause or a fault interrupts the check.
    onward = EXPECTED if event is Event.PLACE_FITS else CHECKING
    assert change.target == machine.leaf == (rows[0].target or onward)


def test_a_place_that_fits_leads_nowhere_before_one_is_expected() -> None:
    machine = at(RESUMING)

    with pytest.raises(MachineError, match="where to go on"):
        machine.fire(Event.PLACE_FITS)

    assert machine.leaf == RESUMING
