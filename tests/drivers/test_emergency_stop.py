"""An emergency stop, a failure, what a reboot forgets: what the driver tells once, and what it remembers."""

from collections.abc import Callable
from typing import Any

import pytest

from drivers.thorvald_protocol import Kind, ModuleFlag, NodeState, RoboteqObject, SdoCommand
from drivers.wire_layout import wire_layout
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Wheel

FL = Wheel.FRONT_LEFT  # node 3
RETOLD_S = 2.5
"""In which a module already in operation tells its constants again."""
Bench = Any
"""The driver and the modules on a virtual bus, of conftest."""


def say(bench: Bench, kind: Kind, **values: float) -> None:
    """A telegram of node 3."""
    bench.far.send(wire_layout().frame(bench.now_s, 3, kind, values))


def emergency(bench: Bench, code: int, register: int = 0, flags: int = 0) -> None:
    say(bench, Kind.EMERGENCY, ErrorCode=code, ErrorRegister=register, FaultFlags=flags, Detail=0)


def told(bench: Bench, seconds: float) -> list[DriverError]:
    """Let time pass, and what the driver raised meanwhile."""
    raised: list[DriverError] = []
    until_s = bench.now_s + seconds
    while bench.now_s < until_s:
        try:
            bench.tick()
        except DriverError as error:
            raised.append(error)
    return raised


def press_by_flag(bench: Bench) -> None:
    bench.modules.modules[FL].muted = frozenset({Kind.EMERGENCY})
    bench.modules.modules[FL].faults = ModuleFlag.POWER_STAGE_OFF.value


def press_by_code(bench: Bench) -> None:
    emergency(bench, 0x9000, register=1)


def press_by_fault_flag(bench: Bench) -> None:
    values = {"Command": SdoCommand.READ_1_BYTE, "Index": RoboteqObject.FAULT_FLAGS, "Subindex": 0}
    say(bench, Kind.SDO_REPLY, **values, Value=0x10)


@pytest.mark.parametrize("press", [press_by_flag, press_by_code, press_by_fault_flag])
def test_each_sign_of_an_emergency_stop_alone_is_told_once_and_by_name(
    press: Callable[[Bench], None], bench: Bench
) -> None:
    bench.start()
    press(bench)

    raised = told(bench, 0.4)

    assert [error.fault for error in raised] == [FaultKind.EMERGENCY_STOP]
    assert str(raised[0]).startswith("module front_left (node 3): ")


def test_a_press_between_two_health_telegrams_is_told_although_it_is_over(bench: Bench) -> None:
    bench.start()
    emergency(bench, 0x9000, register=1)
    emergency(bench, 0x0000)

    raised = told(bench, 1.0)

    assert [error.fault for error in raised] == [FaultKind.EMERGENCY_STOP]
    assert bench.wheels.ready and bench.wheels.stops is None


def test_all_modules_that_are_stopped_are_named_in_one_line(bench: Bench) -> None:
    bench.start()
    for module in bench.modules.modules.values():
        module.button_pressed = True

    raised = told(bench, 2.0)

    assert len(raised) == 1
    assert str(raised[0]).count("EMCY 9000") == 4


def test_while_the_button_is_pressed_the_wheels_are_not_ready_and_it_is_said_why(bench: Bench) -> None:
    bench.start()
    bench.modules.modules[FL].button_pressed = True
    told(bench, 0.5)

    assert not bench.wheels.ready
    assert str(bench.wheels.stops).startswith("emergency stop pressed: module front_left (node 3): ")

    bench.modules.modules[FL].button_pressed = False
    assert told(bench, 1.0) == []
    assert bench.wheels.ready and bench.wheels.stops is None


def test_a_stop_that_the_host_has_set_is_no_news_and_a_release_ends_it(bench: Bench) -> None:
    bench.start()
    bench.wheels.emergency_stop(bench.now_s)
    assert told(bench, 1.0) == []
    assert not bench.wheels.ready

    bench.wheels.release_emergency_stop(bench.now_s)
    bench.wheels.start(bench.now_s)

    assert told(bench, RETOLD_S) == []
    assert bench.wheels.ready


def test_a_button_that_is_pressed_when_the_host_releases_its_own_stop_is_told(bench: Bench) -> None:
    bench.start()
    bench.wheels.emergency_stop(bench.now_s)
    bench.modules.modules[FL].button_pressed = True
    told(bench, 1.0)

    bench.wheels.release_emergency_stop(bench.now_s)
    bench.wheels.start(bench.now_s)
    raised = told(bench, RETOLD_S)

    assert [error.fault for error in raised] == [FaultKind.EMERGENCY_STOP]
    assert not bench.wheels.ready


def test_a_failure_is_told_once_also_when_it_is_over_again(bench: Bench) -> None:
    bench.start()
    bench.modules.modules[FL].faults = ModuleFlag.STALL.value
    bench.modules.step(bench.now_s + 0.005)
    bench.modules.modules[FL].faults = 0

    raised = told(bench, 1.0)

    assert [error.fault for error in raised] == [FaultKind.MODULE_FAILED]
    assert bench.wheels.ready


@pytest.mark.parametrize("state", [NodeState.BOOT], ids=["boot-up word"])
def test_a_module_that_has_booted_is_free_of_errors(bench: Bench, state: NodeState) -> None:
    bench.start()
    emergency(bench, 0x3120, register=5, flags=4)
    told(bench, 0.1)
    assert not bench.report.modules[FL].healthy

    say(bench, Kind.HEARTBEAT, State=state)
    told(bench, RETOLD_S)

    assert bench.report.modules[FL].healthy
    assert bench.wheels.ready


def test_a_lost_connection_forgets_the_emergency_code(bench: Bench) -> None:
    bench.start()
    emergency(bench, 0x3120, register=5)
    bench.tick()
    bench.modules.modules[FL].silent = True
    told(bench, 2.5)
    bench.modules.modules[FL].silent = False
    told(bench, RETOLD_S)

    assert bench.report.modules[FL].healthy


def test_a_start_forgets_the_emergency_code(bench: Bench) -> None:
    bench.start()
    emergency(bench, 0x3120, register=5)
    told(bench, 0.1)

    bench.wheels.start(bench.now_s)
    told(bench, RETOLD_S)

    assert bench.report.modules[FL].healthy


def test_leaving_operation_without_a_boot_forgets_no_error(bench: Bench) -> None:
    bench.start()
    emergency(bench, 0x3120, register=5)
    told(bench, 0.1)

    bench.modules.modules[FL].state = NodeState.PRE_OPERATIONAL
    told(bench, RETOLD_S)

    assert not bench.report.modules[FL].healthy


def test_one_of_two_errors_that_goes_leaves_the_other(bench: Bench) -> None:
    bench.start()
    emergency(bench, 0x3120, register=4, flags=4)
    emergency(bench, 0x8110, register=16, flags=4)
    told(bench, 0.1)

    emergency(bench, 0x0000, register=4, flags=4)
    told(bench, 0.1)
    assert not bench.report.modules[FL].healthy

    emergency(bench, 0x0000)
    told(bench, 0.1)
    assert bench.report.modules[FL].healthy


def test_a_module_that_does_not_tell_its_health_is_not_ready(bench: Bench) -> None:
    bench.modules.modules[FL].muted = frozenset({Kind.HEALTH})
    bench.wheels.start(0.0)
    told(bench, 1.0)

    assert not bench.wheels.ready


def test_a_flood_of_emergency_codes_makes_no_endless_line(bench: Bench) -> None:
    bench.start()
    said = []
    for code in range(0x2000, 0x2400):
        emergency(bench, code, register=1)
        if code % 16 == 0:
            said += told(bench, 0.02)

    assert len(said) == 1
    assert len(str(bench.report.modules[FL].trouble)) < 200
