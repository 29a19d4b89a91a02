"""What a module can mean is taken in; what no module can mean is passed over, and counted."""

from math import pi
from random import Random
from typing import Any

import can
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.module_units import speed_to_rpm, steering_to_counts
from drivers.plausibility import OVER_TOP, plausible
from drivers.thorvald_protocol import FLAG_SIGNALS, Kind, NodeState
from drivers.wire_layout import Telegram, wire_layout
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.settings.robot import Module

MODULE = Module(node_id=1)
TOP_MPS, STEEPEST_RAD = MODULE.top_speed_mps, MODULE.steering_limit_rad
Bench = Any
"""The driver and the modules on a virtual bus, of conftest."""


def motion(speed_mps: float, steering_rad: float) -> Telegram:
    values = {
        "DriveMotorSpeed": speed_to_rpm(MODULE, speed_mps),
        "SteeringMotorSpeed": 0,
        "SteeringCounts": steering_to_counts(MODULE, steering_rad),
    }
    return Telegram(1, Kind.MOTION, values)


def health(temperature_c: float = 30, battery_v: float = 50) -> Telegram:
    flags = dict.fromkeys(FLAG_SIGNALS.values(), 0)
    values = {**flags, "HighestTemperature": temperature_c, "BatteryCurrent": 1, "BatteryVoltage": battery_v}
    return Telegram(1, Kind.HEALTH, values)


@given(st.floats(-TOP_MPS, TOP_MPS), st.floats(-STEEPEST_RAD, STEEPEST_RAD))
def test_every_motion_that_a_module_can_make_is_taken_in(speed_mps: float, steering_rad: float) -> None:
    assert plausible(motion(speed_mps, steering_rad), MODULE)


@pytest.mark.parametrize(
    ("speed_mps", "steering_rad"),
    [(1.4 * TOP_MPS, 0.0), (-1.4 * TOP_MPS, 0.0), (0.0, 1.4 * STEEPEST_RAD), (0.0, -2 * pi * OVER_TOP)],
)
def test_a_motion_beyond_what_a_module_can_make_is_passed_over(speed_mps: float, steering_rad: float) -> None:
    assert not plausible(motion(speed_mps, steering_rad), MODULE)


@pytest.mark.parametrize(
    ("telegram", "can_be"),
    [
        (health(), True),
        (health(temperature_c=-20, battery_v=0), True),
        (health(temperature_c=210), False),
        (health(temperature_c=-60), False),
        (health(battery_v=120), False),
    ],
)
def test_temperatures_and_voltages_must_be_of_this_world(telegram: Telegram, can_be: bool) -> None:
    assert plausible(telegram, MODULE) is can_be


def test_a_heartbeat_knows_four_states() -> None:
    known = [
        state for state in range(256) if plausible(Telegram(1, Kind.HEARTBEAT, {"State": state}), MODULE)
    ]
    assert known == sorted(each.value for each in NodeState)


def test_a_telegram_that_could_not_be_read_is_passed_over() -> None:
    assert not plausible(Telegram(1, Kind.MOTION, {}), MODULE)


def garbled(bench: Bench, seconds: float, per_tick: int, seed: int = 1) -> None:
    """Motion telegrams of one module whose bytes are anything."""
    random, template = Random(seed), wire_layout().frame(0.0, 1, Kind.MOTION, motion(0, 0).values)
    for _ in range(round(seconds / 0.02)):
        for _ in range(per_tick):
            data = random.randbytes(random.randint(0, 8))
            bench.far.send(
                can.Message(
                    timestamp=bench.now_s,
                    arbitration_id=template.arbitration_id,
                    is_extended_id=False,
                    data=data,
                )
            )
        bench.run(0.02, WheelSetpoint(0.3, 0.0))


def test_garbled_telegrams_again_and_again_are_a_fault_of_the_bus(bench: Bench) -> None:
    bench.start()
    with pytest.raises(DriverError, match="what cannot be") as caught:
        garbled(bench, 1.0, per_tick=1)
    assert caught.value.fault is FaultKind.BUS_GARBLED


def test_one_garbled_telegram_changes_nothing(bench: Bench) -> None:
    bench.start()
    template = wire_layout().frame(bench.now_s, 1, Kind.MOTION, motion(0, 0).values)
    template.data = bytearray(b"\x7f\xff\xff\x7f\x7f\xff\xff\x7f")
    before = bench.report.modules[_wheel(bench)]
    bench.far.send(template)
    bench.run(0.02)
    after = bench.report.modules[_wheel(bench)]
    assert (after.speed_mps, after.steering_rad) == (before.speed_mps, before.steering_rad)


def _wheel(bench: Bench) -> Wheel:
    return next(wheel for wheel, module in bench.robot.modules.items() if module.node_id == 1)
