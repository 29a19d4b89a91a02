"""Somebody else commands the wheels: the host says so once, yields, and takes over again only after quiet."""

from collections.abc import Callable
from typing import Any

import can
import pytest

from drivers.takeover import COMMANDS, QUIET_S, Takeover
from drivers.thorvald_protocol import Kind, Mode, NmtCommand, Parameter
from drivers.wire_layout import NO_NODE, Telegram, wire_layout
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import WheelSetpoint

FOREIGN = {
    Kind.DRIVE: {"Sequence": 7_000_000, "DriveSpeed": 100},
    Kind.STEER: {"MaximumSteeringSpeed": 0, "SteeringAngle": 50},
    Kind.MODE: {"Mode": Mode.HOME, "ModeRepeated": Mode.HOME},
    Kind.SET_UP: {"Parameter": Parameter.HOME_COUNT, "Value": 5},
    Kind.NMT: {"Command": NmtCommand.STOP, "Node": 1},
}
Bench = Any
"""The driver and the modules on a virtual bus, of conftest."""


def frame_of(kind: Kind, now_s: float) -> can.Message:
    return wire_layout().frame(now_s, NO_NODE if kind is Kind.NMT else 1, kind, FOREIGN[kind])


def test_every_kind_of_command_is_known() -> None:
    assert set(FOREIGN) == COMMANDS


@pytest.mark.parametrize("kind", list(FOREIGN), ids=lambda kind: kind.value)
def test_a_command_that_the_host_did_not_send_is_told(kind: Kind, bench: Bench) -> None:
    bench.start()
    bench.tap.send(frame_of(kind, bench.now_s))
    with pytest.raises(DriverError, match="commanded by another sender") as caught:
        bench.run(0.1)
    assert caught.value.fault is FaultKind.FOREIGN_COMMAND


def test_what_modules_and_battery_say_is_no_command(bench: Bench) -> None:
    bench.start()
    bench.run(5.0, WheelSetpoint(0.2, 0.1))
    assert not bench.wheels.taken_over


def remote(bench: Bench, seconds: float, each: Callable[[], object] = lambda: None) -> None:
    """A remote that drives for a while; the host wants to drive as well."""
    until_s = bench.now_s + seconds
    while bench.now_s < until_s:
        bench.tap.send(frame_of(Kind.DRIVE, bench.now_s))
        try:
            bench.run(0.02, WheelSetpoint(0.4, 0.0))
        except DriverError as error:
            assert error.fault is FaultKind.FOREIGN_COMMAND
            each()


def test_a_take_over_is_told_once_however_long_it_lasts(bench: Bench) -> None:
    bench.start()
    told: list[float] = []
    remote(bench, 3.0, lambda: told.append(bench.now_s))
    assert len(told) == 1


def test_the_host_commands_nothing_while_another_does(bench: Bench) -> None:
    bench.start()
    remote(bench, 0.1)
    bench.frames()
    remote(bench, 1.0)
    layout = wire_layout()
    drives = [layout.read(frame) for frame in bench.frames()]
    host = [each for each in drives if each and each.kind in (Kind.DRIVE, Kind.STEER)]
    assert host == [], "what the tap sent itself it does not hear"
    assert bench.wheels.taken_over


def test_the_wheels_are_the_hosts_again_after_quiet_and_not_before(bench: Bench) -> None:
    bench.start()
    remote(bench, 0.5)
    bench.run(QUIET_S - 0.1, WheelSetpoint(0.4, 0.0))
    assert bench.wheels.taken_over
    bench.run(0.2, WheelSetpoint(0.4, 0.0))
    assert not bench.wheels.taken_over
    bench.run(1.0, WheelSetpoint(0.4, 0.0))
    assert all(wheel.speed_mps > 0.3 for wheel in bench.modules.wheel_states().values())


def test_a_second_take_over_is_told_again(bench: Bench) -> None:
    bench.start()
    told: list[float] = []
    remote(bench, 0.5, lambda: told.append(bench.now_s))
    bench.run(QUIET_S + 0.1)
    remote(bench, 0.5, lambda: told.append(bench.now_s))
    assert len(told) == 2


def test_what_is_said_of_a_command_names_the_module_and_the_telegram() -> None:
    telegram = Telegram(1, Kind.DRIVE, {"Sequence": 3, "DriveSpeed": 100})
    said = Takeover().note(telegram, "module rear_right (node 1)", 0.0)
    assert (
        said
        == "module rear_right (node 1) is commanded by another sender: RPDO1_Drive Sequence 3, DriveSpeed 100"
    )
