"""An emergency stop that a person has pressed: the wheels stand until a person says otherwise."""

from collections.abc import Callable

import pytest

from drivers.thorvald_protocol import Kind, Mode, ModuleFlag
from drivers.wire_layout import wire_layout
from fieldnav.faults import FaultKind
from fieldnav.mission.loop import TICK_S
from fieldnav.mission.operating import Operating
from fieldnav.operator.confirmation import Confirmations, parse_confirmations
from states.behaviour import Step
from states.names import Event, Follow
from states.table import CHECKING, LATCHED, PAUSED, RECOVERABLE

PRESSED = FaultKind.EMERGENCY_STOP.value


def press(rig, seconds: float) -> None:
    """Press the robot's button, and pull it out after so long."""
    for module in rig.modules.modules.values():
        module.button_pressed = True
    rig.run(seconds)
    for module in rig.modules.modules.values():
        module.button_pressed = False


def said(rig) -> list[str]:
    """The journal's lines that name the emergency stop."""
    return [
        f"{line.event}: {line.reason}" for line in rig.lines() if PRESSED in f"{line.event}: {line.reason}"
    ]


@pytest.mark.parametrize("seconds", [TICK_S, 1.0])
def test_a_stop_that_is_released_moves_nothing_until_a_person_says_so(rig, seconds: float) -> None:
    operating = Operating(rig.mission)
    operating.watch()
    press(rig, seconds)
    rig.run(1.5)

    assert rig.mission.course.machine.leaf == RECOVERABLE
    assert rig.fastest_mps() == 0
    assert len(said(rig)) == 1 and said(rig)[0].startswith(f"fail: {PRESSED}: module rear_right (node 1)")

    assert operating.resume(rig.now_s) == ""
    rig.run(1.0)
    assert Follow.TRACKING in rig.mission.course.machine.leaf
    assert rig.fastest_mps() > 0.2


def test_a_reset_goes_on_as_well(rig) -> None:
    press(rig, 0.5)
    rig.run(1.0)

    assert Operating(rig.mission).reset(rig.now_s) == ""
    rig.run(4.0)

    assert rig.fastest_mps() > 0.2


def test_a_resume_while_the_button_is_pressed_moves_nothing_and_says_so(rig) -> None:
    operating = Operating(rig.mission)
    operating.watch()
    for module in rig.modules.modules.values():
        module.button_pressed = True
    rig.run(1.0)

    refused = operating.resume(rig.now_s)

    assert refused.startswith(f"{PRESSED}: module rear_right (node 1): power stage off")
    rig.run(0.5)
    assert rig.mission.course.machine.leaf == RECOVERABLE


def test_a_reset_while_the_button_is_pressed_stops_at_the_checks_and_says_so(rig) -> None:
    for module in rig.modules.modules.values():
        module.button_pressed = True
    rig.run(1.0)

    assert Operating(rig.mission).reset(rig.now_s) == ""
    rig.run(1.0)

    assert rig.mission.course.machine.leaf == RECOVERABLE
    assert rig.lines()[-1].source == "Checking"
    assert len(said(rig)) == 2


def test_a_stop_while_paused_is_said_and_ended_by_a_person(rig) -> None:
    operating = Operating(rig.mission)
    operating.watch()
    operating.pause(rig.now_s)
    rig.run(1.0)
    assert rig.mission.course.machine.leaf == PAUSED

    press(rig, 0.1)
    rig.run(1.0)

    assert rig.mission.course.machine.leaf == RECOVERABLE
    assert len(said(rig)) == 1
    assert operating.resume(rig.now_s) == ""
    rig.run(1.0)
    assert Follow.TRACKING in rig.mission.course.machine.leaf


@pytest.mark.parametrize(("event", "leaf"), [(Event.FAIL, RECOVERABLE), (Event.LATCH, LATCHED)])
def test_a_stop_in_a_fault_is_noted_each_time(rig, event: Event, leaf) -> None:
    rig.mission.break_off(rig.now_s, event, "something else")
    rig.run(0.5)
    press(rig, 0.1)
    rig.run(1.5)
    press(rig, 0.1)
    rig.run(1.5)

    assert rig.mission.course.machine.leaf == leaf
    assert [line.split(":")[0] for line in said(rig)] == [PRESSED, PRESSED]


def test_a_yes_to_a_question_is_not_given_by_resuming_after_a_stop(rig_with) -> None:
    rig = rig_with(Confirmations(parse_confirmations("exit")))
    operating = Operating(rig.mission)
    operating.watch()
    rig.proposes(Event.LANE_ENDED)
    rig.run(TICK_S)
    press(rig, 0.1)
    rig.run(1.0)

    assert operating.resume(rig.now_s) == ""
    rig.proposes(Event.LANE_ENDED)
    rig.run(TICK_S)

    assert rig.mission.course.machine.leaf == PAUSED
    assert "resume says yes" in rig.lines()[-1].reason


def test_a_runaway_wheel_is_stopped_released_by_a_reset_and_the_robot_drives_again(rig) -> None:
    broken = next(iter(rig.modules.modules.values()))
    broken.runaway_mps = 1.0
    rig.run(1.0)
    assert rig.mission.course.machine.leaf == LATCHED
    assert broken.emergency_stop and rig.fastest_mps() == 0
    assert said(rig) == [], "nobody has pressed the button"
    broken.runaway_mps = None

    assert Operating(rig.mission).reset(rig.now_s) == ""
    rig.run(4.0)

    assert not any(module.emergency_stop for module in rig.modules.modules.values())
    assert rig.fastest_mps() > 0.2
    assert said(rig) == []


def test_a_mission_that_begins_with_the_button_pressed_says_so_in_the_checks(rig) -> None:
    rig.mission.break_off(rig.now_s, Event.LATCH, "to begin again")
    for module in rig.modules.modules.values():
        module.button_pressed = True
    rig.mission.course.go(rig.now_s, Step(event=Event.RESET))
    rig.mission.start(rig.now_s)
    assert rig.mission.course.machine.leaf == CHECKING
    rig.run(1.0)

    assert rig.mission.course.machine.leaf == RECOVERABLE
    assert rig.lines()[-1].reason.startswith(PRESSED)


def stall(rig) -> None:
    next(iter(rig.modules.modules.values())).faults = ModuleFlag.STALL.value


def unsee_a_mode(rig) -> None:
    next(iter(rig.modules.modules.values())).mode = Mode.DECOUPLED


@pytest.mark.parametrize(
    ("strike", "fault"), [(stall, FaultKind.MODULE_FAILED), (unsee_a_mode, FaultKind.MODULE_MODE)]
)
def test_a_failure_or_another_mode_stops_the_wheels_for_a_person(
    rig, strike: Callable[[object], None], fault: FaultKind
) -> None:
    strike(rig)
    rig.run(2.0)

    assert rig.mission.course.machine.leaf == RECOVERABLE
    assert rig.lines()[-1].reason.startswith(f"{fault.value}: module rear_right (node 1)")
    assert rig.fastest_mps() == 0


def test_after_a_foreign_mode_a_resume_moves_no_wheel_that_is_not_in_drive(rig) -> None:
    operating = Operating(rig.mission)
    operating.watch()
    values = {"Mode": Mode.DECOUPLED, "ModeRepeated": Mode.DECOUPLED}
    rig.far.send(wire_layout().frame(rig.now_s, 1, Kind.MODE, values))  # the host hears it
    broken = next(iter(rig.modules.modules.values()))
    broken.mode = Mode.DECOUPLED
    rig.run(0.5)
    assert rig.mission.course.machine.leaf == PAUSED
    assert operating.resume(rig.now_s) == "somebody else commands the wheels"

    broken.muted = frozenset({Kind.SDO_REPLY})
    rig.run(1.0)
    assert operating.resume(rig.now_s).startswith("module not in drive mode: module rear_right (node 1) has")
    broken.muted = frozenset()
    rig.run(1.0)
    assert broken.mode is Mode.DRIVE
    assert operating.resume(rig.now_s) == ""
    rig.run(1.0)
    assert min(abs(wheel.speed_mps) for wheel in rig.modules.wheel_states().values()) > 0.2
