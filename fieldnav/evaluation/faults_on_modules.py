"""The injectors of the wheel modules' faults; one module breaks, but where a robot is blocked all of them."""

from functools import partial

from drivers.thorvald_protocol import Kind, ModuleFlag, Parameter
from fieldnav.evaluation.faults_injection import Injection, broken
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.faults import FaultKind

RUNAWAY_MPS = 1.0
"""Twice the working speed."""
WEAK_SHARE = 0.6
"""Of its set-point, which a drive that drags along still reaches."""
LATE = frozenset({FaultKind.MODULE_LATE})
"""What a module that falls silent is at first."""


def of_modules() -> tuple[Injection, ...]:
    """Each with how it passes, where it does."""
    return (
        Injection(FaultKind.MODULE_LATE, partial(_mute, kinds=frozenset({Kind.MOTION})), _speak_again),
        Injection(FaultKind.MODULE_SILENT, _silence, also=LATE),
        Injection(FaultKind.MODULE_REBOOTED, _reboot, also=LATE),
        Injection(FaultKind.MODULE_UNHEALTHY, _stall, _recover),
        Injection(FaultKind.MODULE_OTHER, _change_constants),
        Injection(FaultKind.STEERING_STUCK, _stick),
        Injection(FaultKind.DRIVE_RUNAWAY, _run_away),
        Injection(FaultKind.DRIVE_WEAK, partial(_weaken, share=0.0), called="drive dead"),
        Injection(FaultKind.DRIVE_WEAK, partial(_weaken, share=WEAK_SHARE), called="drive weak"),
        Injection(FaultKind.STANDS_STILL, _block),
    )


def _mute(rig: Rig, kinds: frozenset[Kind]) -> None:
    broken(rig).muted = kinds


def _speak_again(rig: Rig) -> None:
    _mute(rig, frozenset())


def _silence(rig: Rig) -> None:
    broken(rig).silent = True


def _reboot(rig: Rig) -> None:
    broken(rig).reboot()


def _stall(rig: Rig) -> None:
    broken(rig).faults |= ModuleFlag.STALL


def _recover(rig: Rig) -> None:
    broken(rig).faults = 0


def _change_constants(rig: Rig) -> None:
    broken(rig).kept[Parameter.HOME_COUNT] += 1


def _stick(rig: Rig) -> None:
    broken(rig).steering_stuck = True


def _run_away(rig: Rig) -> None:
    broken(rig).runaway_mps = RUNAWAY_MPS


def _weaken(rig: Rig, share: float) -> None:
    broken(rig).drive_share = share


def _block(rig: Rig) -> None:
    for module in rig.modules.modules.values():
        module.blocked = True
