"""What the signs of a fault in a wheel module mean: a stop that a person made, a failure, or what passes.

A module tells of a fault in three ways: the flags of TPDO3, those of object 2112, and emergency telegrams
(EMCY). The signs' meanings are those of CiA 301 and of the motor controller's manual; which of them may pass
by itself is our choice.
"""

from collections.abc import Collection, Iterator, Mapping
from enum import IntFlag
from types import MappingProxyType

from drivers.thorvald_protocol import FaultFlag, Mode, ModuleFlag
from fieldnav.faults import FaultKind, Trouble

GRAVEST_FIRST = (
    FaultKind.EMERGENCY_STOP,
    FaultKind.MODULE_FAILED,
    FaultKind.MODULE_MODE,
    FaultKind.MODULE_UNHEALTHY,
)

OF_FLAG: Mapping[IntFlag, FaultKind] = MappingProxyType(
    {
        ModuleFlag.POWER_STAGE_OFF: FaultKind.EMERGENCY_STOP,
        ModuleFlag.DRIVE_ENCODER: FaultKind.MODULE_FAILED,  # the speed that it tells may be wrong
        ModuleFlag.STEERING_ENCODER: FaultKind.MODULE_FAILED,  # the angle that it tells may be wrong
        ModuleFlag.ALIGNMENT: FaultKind.MODULE_FAILED,
        ModuleFlag.HOMING_COUNT_EXCEEDED: FaultKind.MODULE_FAILED,  # straight ahead is not where it was
        ModuleFlag.STALL: FaultKind.MODULE_FAILED,  # something blocks the wheel, a foot perhaps
        ModuleFlag.ILLEGAL_COMMAND: FaultKind.MODULE_UNHEALTHY,  # the module has not obeyed it
    }
)
"""TPDO3. Its bit 0, "healthy", falls also for what passes; what is graver has a sign of its own."""

OF_FAULT_FLAG: Mapping[IntFlag, FaultKind] = MappingProxyType(
    {
        FaultFlag.EMERGENCY_STOP: FaultKind.EMERGENCY_STOP,
        FaultFlag.OVERHEAT: FaultKind.MODULE_FAILED,  # it cools in minutes, not while the wheels are held
        FaultFlag.SHORT_CIRCUIT: FaultKind.MODULE_FAILED,
        FaultFlag.SENSOR_OR_SET_UP: FaultKind.MODULE_FAILED,
        FaultFlag.MOSFET: FaultKind.MODULE_FAILED,
        FaultFlag.DEFAULT_CONFIGURATION: FaultKind.MODULE_FAILED,
        FaultFlag.OVERVOLTAGE: FaultKind.MODULE_UNHEALTHY,  # as when it brakes; motors are off meanwhile
        FaultFlag.UNDERVOLTAGE: FaultKind.MODULE_UNHEALTHY,  # as when all wheels set off at once
    }
)
"""Object 2112. A flag that is not known counts as a failure."""

EMERGENCY_CLASS = 0xF000
"""The part of an EMCY code that names its class (CiA 301, table of emergency error codes)."""

OF_EMERGENCY: Mapping[int, tuple[str, FaultKind]] = MappingProxyType(
    {
        0x1000: ("generic error", FaultKind.MODULE_FAILED),
        0x2000: ("current", FaultKind.MODULE_FAILED),
        0x3000: ("voltage", FaultKind.MODULE_UNHEALTHY),
        0x4000: ("temperature", FaultKind.MODULE_FAILED),
        0x5000: ("hardware", FaultKind.MODULE_FAILED),
        0x6000: ("software", FaultKind.MODULE_FAILED),
        0x7000: ("additional module", FaultKind.MODULE_FAILED),
        0x8000: ("bus", FaultKind.MODULE_UNHEALTHY),  # telegrams were lost or wrong; none was obeyed
        0x9000: ("external error", FaultKind.EMERGENCY_STOP),
        0xF000: ("device specific", FaultKind.MODULE_FAILED),
    }
)
"""EMCY, by class. A code of no known class counts as a failure."""

Sign = tuple[FaultKind, str]
"""What a sign means, and how it is called."""


def module_trouble(
    name: str, flags: int | None, fault_flags: int | None, codes: Collection[int], mode: int | None
) -> Trouble | None:
    """The gravest of what a module says of itself, with every sign in words; None while all is well."""
    signs = [*_of_flags(flags), *_of_fault_flags(fault_flags), *_of_codes(codes), *_of_mode(mode)]
    kinds = {kind for kind, _ in signs}
    for kind in GRAVEST_FIRST:
        if kind in kinds:
            return Trouble(kind, f"{name}: {', '.join(dict.fromkeys(word for _, word in signs))}")
    return None


def graver(one: Trouble, other: Trouble | None) -> bool:
    """Whether the first is at least as grave as the other."""
    return other is None or GRAVEST_FIRST.index(one.fault) <= GRAVEST_FIRST.index(other.fault)


def _of_flags(flags: int | None) -> Iterator[Sign]:
    if flags is None:
        return
    known = [(kind, _word(flag)) for flag, kind in OF_FLAG.items() if flags & flag]
    yield from known
    if not known and not flags & ModuleFlag.HEALTHY:
        yield FaultKind.MODULE_UNHEALTHY, "controller not healthy"


def _of_fault_flags(fault_flags: int | None) -> Iterator[Sign]:
    if not fault_flags:
        return
    yield from ((kind, _word(flag)) for flag, kind in OF_FAULT_FLAG.items() if fault_flags & flag)
    unknown = fault_flags & ~sum(OF_FAULT_FLAG)
    if unknown:
        yield FaultKind.MODULE_FAILED, f"fault flags {unknown:04X} of object 2112"


def _of_codes(codes: Collection[int]) -> Iterator[Sign]:
    for code in codes:
        word, kind = OF_EMERGENCY.get(code & EMERGENCY_CLASS, ("unknown", FaultKind.MODULE_FAILED))
        yield kind, f"EMCY {code:04X} ({word})"


def _of_mode(mode: int | None) -> Iterator[Sign]:
    if mode is not None and mode != Mode.DRIVE:
        known = {each.value: each.name.lower() for each in Mode}
        yield FaultKind.MODULE_MODE, f"in mode {known.get(mode, mode)}, not drive"


def _word(flag: IntFlag) -> str:
    """A flag for a person: "power stage off"."""
    return str(flag.name).lower().replace("_", " ")
