"""What a person asks of a mission: pause, resume, reset, and the yes to a question."""

import pytest

from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.mission.loop import TICK_S
from fieldnav.mission.operating import Operating
from fieldnav.operator.confirmation import Confirmations, parse_confirmations
from states.behaviour import Step
from states.names import Event, Follow, Phase, Sidestep, text
from states.table import FINISHED, LATCHED, PAUSED, RESUMING


def test_a_pause_stops_the_wheels_and_a_resume_goes_on_where_it_was(rig) -> None:
    operating = Operating(rig.mission)
    operating.watch()

    assert operating.pause(rig.now_s) == ""
    rig.run(1.5)
    assert rig.mission.course.machine.leaf == PAUSED
    assert rig.fastest_mps() == 0
    assert operating.resume(rig.now_s) == ""
    rig.run(1.0)

    assert Follow.TRACKING in rig.mission.course.machine.leaf
    assert rig.fastest_mps() > 0.2


def test_what_cannot_be_done_is_said_and_changes_nothing(rig) -> None:
    operating = Operating(rig.mission)
    before = len(rig.lines())

    assert "nothing to resume in Forward.Follow.Tracking" in operating.resume(rig.now_s)
    assert "nothing to reset in Forward.Follow.Tracking" in operating.reset(rig.now_s)
    rig.mission.end(rig.now_s, "stopped")
    assert "nothing to pause in Fault.Recoverable" in operating.pause(rig.now_s)

    assert len(rig.lines()) == before + 1


def test_a_robot_that_was_moved_meanwhile_is_not_resumed_before_it_has_looked_for_its_place(rig) -> None:
    operating = Operating(rig.mission)
    operating.watch()
    operating.pause(rig.now_s)
    rig.run(1.0)
    rig.mission.travel.sideways_m += 0.6  # as the wheels tell when somebody drives it by a remote

    refused = operating.resume(rig.now_s)

    assert "was moved by 0.6" in refused and "reset" in refused
    assert rig.mission.course.machine.leaf == PAUSED
    assert operating.reset(rig.now_s) == ""
    rig.run(1.5)
    assert text(RESUMING) in [line.target for line in rig.lines()]


def test_a_reset_leads_from_a_latched_fault_to_the_place_in_the_ledger(rig) -> None:
    operating = Operating(rig.mission)
    rig.mission.break_off(rig.now_s, Event.LATCH, "drive runs away")
    rig.run(1.0)
    assert rig.mission.course.machine.leaf == LATCHED

    assert operating.reset(rig.now_s) == ""
    rig.run(2.0)

    events = [line.event for line in rig.lines()]
    assert events[-4:] == ["reset", "start", "resume", "place fits"]
    assert Follow.TRACKING in rig.mission.course.machine.leaf


def test_a_reset_releases_the_emergency_stop_that_a_runaway_wheel_has_caused(rig) -> None:
    rig.mission.wheels.emergency_stop(rig.now_s)
    rig.run(0.2)
    assert all(module.emergency_stop for module in rig.modules.modules.values())
    rig.mission.break_off(rig.now_s, Event.LATCH, "drive runs away")
    rig.run(0.5)

    assert Operating(rig.mission).reset(rig.now_s) == ""
    rig.run(0.2)

    assert not any(module.emergency_stop for module in rig.modules.modules.values())


def test_nothing_is_resumed_while_a_remote_commands_the_wheels(rig) -> None:
    operating = Operating(rig.mission)
    operating.watch()
    values = {"Sequence": 9, "DriveSpeed": 0}
    rig.far.send(wire_layout().frame(rig.now_s, 3, Kind.DRIVE, values))
    rig.run(0.1)

    assert rig.mission.course.machine.leaf == PAUSED
    assert "foreign command: module front_left (node 3)" in rig.lines()[-1].reason
    assert "somebody else commands the wheels" in operating.resume(rig.now_s)
    rig.run(1.2)
    assert operating.resume(rig.now_s) == ""


def test_a_mission_that_has_finished_is_not_begun_again(rig) -> None:
    for event in (Event.LANE_ENDED, Event.LAST_LANE_LEFT):
        rig.mission.course.machine.fire(event)
    assert rig.mission.course.machine.leaf == FINISHED

    assert "nothing to reset in Finished" in Operating(rig.mission).reset(rig.now_s)


@pytest.mark.parametrize("word", ["exit", "switch"])
def test_what_must_be_confirmed_waits_for_a_yes(rig_with, word: str) -> None:
    rig = rig_with(Confirmations(parse_confirmations(word)))
    operating = Operating(rig.mission)
    asked = {"exit": Event.LANE_ENDED, "switch": Event.LANE_LEFT}[word]
    if word == "switch":
        rig.mission.course.go(rig.now_s, Step(event=Event.LANE_ENDED))
    operating.watch()
    rig.proposes(asked)

    rig.run(TICK_S)
    assert rig.mission.course.machine.leaf == PAUSED
    assert "resume says yes" in rig.lines()[-1].reason
    assert operating.resume(rig.now_s) == ""
    rig.proposes(asked)
    rig.run(TICK_S)

    after = rig.mission.course.machine.leaf
    assert Phase.EXIT in after if word == "exit" else Sidestep.ORIENTING in after
