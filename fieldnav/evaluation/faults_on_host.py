"""The injectors of what befalls the host: its bus, its battery, its time, its disk, its program."""

import time

from drivers.simulated_battery import CAPACITY_AS
from drivers.thorvald_protocol import Mode
from fieldnav.evaluation.faults_injection import Injection, broken
from fieldnav.evaluation.faults_mistake import Mistaken
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.faults import FaultKind

FLOOD, ERRORS = 100, 4
"""Frames in each round of 20 ms: 5000 and 200 a second."""
REMOTE_S = 3.0
SUSPENDED_S, LATE_ROUND_S, LATE_EVERY_S, LATE_ROUNDS = 5.0, 0.3, 1.0, 3
WALL_JUMP_S = 3600.0
LEFT_SHARE, DRAIN_A = 0.05, 1000.0
"""Of the battery's charge, after it has given so much current."""


def of_bus() -> tuple[Injection, ...]:
    """The bus itself, and others on it."""
    return (
        Injection(FaultKind.BUS_OFF, _bus_off),
        Injection(FaultKind.BUS_FLOODED, _flood),
        Injection(FaultKind.BUS_GARBLED, _garble),
        Injection(FaultKind.BUS_GARBLED, _disturb, called="error frames"),
        Injection(FaultKind.FOREIGN_COMMAND, _take_over),
        Injection(FaultKind.FOREIGN_COMMAND, _decouple, called="drive mode set by another"),
    )


def of_host() -> tuple[Injection, ...]:
    """The computer and what it runs from."""
    return (
        Injection(FaultKind.BATTERY_FLAT, _drain),
        Injection(FaultKind.WALL_CLOCK, _set_wall_clock),
        Injection(FaultKind.LOOP_LATE, _stumble),
        Injection(FaultKind.LOOP_LATE, _suspend, called="process suspended"),
        Injection(FaultKind.LOOP_LATE, _suspend_within, called="process suspended in a round"),
        Injection(FaultKind.DISK_FULL, _fill_disk),
        Injection(FaultKind.PROGRAM, _make_mistake),
        Injection(FaultKind.PROCESS_KILLED, _kill),
    )


def _bus_off(rig: Rig) -> None:
    rig.bus.off = True


def _flood(rig: Rig) -> None:
    rig.intruder.flood = FLOOD


def _garble(rig: Rig) -> None:
    rig.bus.garbled_node = broken(rig).module.node_id


def _disturb(rig: Rig) -> None:
    rig.intruder.errors = ERRORS


def _take_over(rig: Rig) -> None:
    rig.intruder.commands_until_s = rig.now_s + REMOTE_S


def _decouple(rig: Rig) -> None:
    rig.intruder.mode = Mode.DECOUPLED


def _drain(rig: Rig) -> None:
    battery = rig.modules.battery
    battery.advance(CAPACITY_AS * (battery.charge - LEFT_SHARE) / DRAIN_A, DRAIN_A)


def _set_wall_clock(rig: Rig) -> None:
    """An hour on; the process that it is done in is a copy of the rig's own, and ends soon."""
    right = time.time
    time.time = lambda: right() + WALL_JUMP_S


def _stumble(rig: Rig) -> None:
    for late in range(LATE_ROUNDS):
        at_s = rig.now_s + late * LATE_EVERY_S
        rig.absent.append((at_s, at_s + LATE_ROUND_S))


def _suspend(rig: Rig) -> None:
    rig.absent.append((rig.now_s, rig.now_s + SUSPENDED_S))


def _suspend_within(rig: Rig) -> None:
    rig.stalled_s = SUSPENDED_S


def _fill_disk(rig: Rig) -> None:
    rig.paper.fill_disk()


def _make_mistake(rig: Rig) -> None:
    rig.mission.course.behaviours.current = Mistaken(rig.guides)


def _kill(rig: Rig) -> None:
    rig.killed = True
