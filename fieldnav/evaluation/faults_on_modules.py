"""The injectors of the wheel modules' faults; one module breaks, but where a robot is blocked all of them."""

from functools import partial
from math import inf

from drivers.thorvald_protocol import Kind, Mode, ModuleFlag, Parameter
from fieldnav.evaluation.faults_injection import Injection, broken
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.faults import FaultKind

RUNAWAY_MPS = 1.0
"""Twice the working speed."""
PRESSED_S = (0.1, 1.0)
"""So long the emergency stop is pressed, beside for ever: as one health telegram takes, and as ten."""
WEAK_SHARE = 0.6
"""Of its set-point, which a drive that drags along still reaches."""
LATE = frozenset({FaultKind.MODULE_LATE})
"""What a module that falls silent is at first."""
WEAK = frozenset({FaultKind.DRIVE_WEAK})
"""What a module in another mode is as well: its wheel is looked at in every round, its mode now and then."""


def of_modules() -> tuple[Injection, ...]:
    """Each with how it passes, where it does."""
    return (
        Injection(FaultKind.MODULE_LATE, partial(_mute, kinds=frozenset({Kind.MOTION})), _speak_again),
        Injection(FaultKind.MODULE_SILENT, _silence, also=LATE),
        Injection(FaultKind.MODULE_REBOOTED, _reboot, also=LATE),
        Injection(FaultKind.EMERGENCY_STOP, _press),
        *map(_pressed_for, PRESSED_S),
        Injection(FaultKind.MODULE_FAILED, _stall),
        Injection(FaultKind.MODULE_UNHEALTHY, _sag, _recover),
        Injection(FaultKind.MODULE_MODE, partial(_change_mode, mode=Mode.DECOUPLED), instead=WEAK),
        Injection(
            FaultKind.MODULE_MODE, partial(_change_mode, mode=Mode.HOME), called="module homes", instead=WEAK
        ),
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


def _pressed_for(seconds: float) -> Injection:
    called = f"{FaultKind.EMERGENCY_STOP.value} for {seconds:g} s"
    return Injection(
        FaultKind.EMERGENCY_STOP, partial(_press, seconds=seconds), called=called, lasts_s=seconds
    )


def _press(rig: Rig, seconds: float = inf) -> None:
    """The button of the robot stops every module; it is pulled out after so long."""
    pull_s = rig.now_s + seconds

    def hold() -> None:
        for module in rig.modules.modules.values():
            module.button_pressed = rig.now_s < pull_s

    hold()
    rig.after.append(hold)


def _stall(rig: Rig) -> None:
    broken(rig).faults |= ModuleFlag.STALL


def _sag(rig: Rig) -> None:
    broken(rig).undervoltage = True


def _recover(rig: Rig) -> None:
    broken(rig).undervoltage = False


def _change_mode(rig: Rig, mode: Mode) -> None:
    """By a telegram that the host did not hear."""
    broken(rig).mode = mode


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
