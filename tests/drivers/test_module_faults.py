"""What each sign of a fault means: a stop that a person made, a failure, or what may pass by itself."""

import pytest

from drivers.module_faults import module_trouble
from drivers.thorvald_protocol import FLAG_SIGNALS, FaultFlag, ModuleFlag
from fieldnav.faults import FaultKind

STOP, FAILED, UNHEALTHY = FaultKind.EMERGENCY_STOP, FaultKind.MODULE_FAILED, FaultKind.MODULE_UNHEALTHY
FLAGS = {
    ModuleFlag.DRIVE_ENCODER: FAILED,
    ModuleFlag.STEERING_ENCODER: FAILED,
    ModuleFlag.ALIGNMENT: FAILED,
    ModuleFlag.POWER_STAGE_OFF: STOP,
    ModuleFlag.STALL: FAILED,
    ModuleFlag.HOMING_COUNT_EXCEEDED: FAILED,
    ModuleFlag.ILLEGAL_COMMAND: UNHEALTHY,
}
FAULT_FLAGS = {
    FaultFlag.OVERHEAT: FAILED,
    FaultFlag.OVERVOLTAGE: UNHEALTHY,
    FaultFlag.UNDERVOLTAGE: UNHEALTHY,
    FaultFlag.SHORT_CIRCUIT: FAILED,
    FaultFlag.EMERGENCY_STOP: STOP,
    FaultFlag.SENSOR_OR_SET_UP: FAILED,
    FaultFlag.MOSFET: FAILED,
    FaultFlag.DEFAULT_CONFIGURATION: FAILED,
}
CODES = {
    0x1000: FAILED,
    0x2310: FAILED,
    0x3120: UNHEALTHY,
    0x4210: FAILED,
    0x5000: FAILED,
    0x6100: FAILED,
    0x7100: FAILED,
    0x8110: UNHEALTHY,
    0x8220: UNHEALTHY,
    0x9000: STOP,
    0xA000: FAILED,
    0xFF01: FAILED,
}


def meaning(flags=None, fault_flags=None, codes=(), mode=None):
    """The fault that a module's signs mean."""
    found = module_trouble("module", flags, fault_flags, codes, mode)
    return found and found.fault


def test_every_flag_has_a_meaning() -> None:
    assert {int(flag) for flag in FLAGS} == set(FLAG_SIGNALS) - {int(ModuleFlag.HEALTHY)}
    assert set(FAULT_FLAGS) == set(FaultFlag)


@pytest.mark.parametrize("flag", list(FLAGS), ids=lambda flag: flag.name)
def test_a_flag_of_the_health_telegram_means_what_the_table_says(flag) -> None:
    assert meaning(flags=int(flag)) is FLAGS[flag]
    assert meaning(flags=int(flag | ModuleFlag.HEALTHY)) is FLAGS[flag]


@pytest.mark.parametrize("flag", list(FAULT_FLAGS), ids=lambda flag: flag.name)
def test_a_fault_flag_read_back_means_what_the_table_says(flag) -> None:
    assert meaning(fault_flags=int(flag)) is FAULT_FLAGS[flag]


@pytest.mark.parametrize("code", list(CODES), ids=lambda code: f"{code:04X}")
def test_an_emergency_code_means_what_its_class_does(code) -> None:
    assert meaning(codes=[code]) is CODES[code]


def test_a_module_that_says_nothing_but_that_it_is_not_healthy_may_come_back_by_itself() -> None:
    assert meaning(flags=0) is UNHEALTHY
    assert meaning(flags=int(ModuleFlag.HEALTHY), fault_flags=0, mode=0) is None


def test_an_unknown_fault_flag_is_a_failure() -> None:
    found = module_trouble("module", 1, 0x104, (), 0)
    assert found is not None and found.fault is FAILED
    assert found.said == "module: undervoltage, fault flags 0100 of object 2112"


def test_the_gravest_sign_names_the_fault_and_every_sign_is_said() -> None:
    found = module_trouble(
        "module front_left (node 3)",
        int(ModuleFlag.STALL | ModuleFlag.POWER_STAGE_OFF),
        int(FaultFlag.UNDERVOLTAGE | FaultFlag.EMERGENCY_STOP),
        [0x9000],
        2,
    )
    assert str(found) == (
        "emergency stop pressed: module front_left (node 3): power stage off, stall, emergency stop, "
        "undervoltage, EMCY 9000 (external error), in mode decoupled, not drive"
    )
