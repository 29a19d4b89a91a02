"""The injectors of the cameras' faults; they strike the cameras that guide, both where none does."""

from functools import partial

from fieldnav.evaluation.faults_injection import Injection
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName
from fieldnav.simulation.injection_camera import CameraFault

LATE_S = 0.8
OLD_S = 3.0
NOT_OF_NOW = frozenset({FaultKind.CAMERA_FROZEN, FaultKind.FRAMES_LATE})
"""What pictures of the past are as well: a camera that has just begun to lag shows one and the same."""
SLOW_HZ, SLOWER_HZ, SLOWER_AFTER_S = 5.0, 3.0, 4.0
"""Frames a second, of fifteen; and after a while fewer still."""


def of_cameras() -> tuple[Injection, ...]:
    """Each with how it passes."""
    return (
        _injection(FaultKind.CAMERA_FROZEN, CameraFault.FROZEN),
        _injection(FaultKind.CAMERA_BLACK, CameraFault.BLACK),
        _injection(FaultKind.CAMERA_WHITE, CameraFault.WHITE),
        _injection(FaultKind.CAMERA_UNPLUGGED, CameraFault.UNPLUGGED),
        Injection(FaultKind.CAMERA_SLOW, _slow),
        _injection(FaultKind.CAMERA_SIZE, CameraFault.SIZE),
        _injection(FaultKind.CAMERA_TURNED, CameraFault.TURNED),
        _injection(FaultKind.FRAMES_LATE, CameraFault.LATE, LATE_S),
        _lie(FaultKind.CAMERA_BLIND, CameraFault.COLOURLESS),
        _lie(FaultKind.CAMERA_BLIND, CameraFault.MUDDY),
        _lie(FaultKind.CAMERA_BLIND, CameraFault.ONE_PIXEL),
        _lie(FaultKind.CAMERA_PAST, CameraFault.CLOCK),
        _lie(FaultKind.CAMERA_PAST, CameraFault.IN_TURN),
        _lie(FaultKind.CAMERA_PAST, CameraFault.OLD, OLD_S),
    )


def _injection(kind: FaultKind, fault: CameraFault, measure: float = 0.0) -> Injection:
    return Injection(kind, partial(_break, fault=fault, measure=measure), _mend)


def _lie(kind: FaultKind, fault: CameraFault, measure: float = 0.0) -> Injection:
    """Pictures that may well be taken for good ones."""
    return Injection(
        kind,
        partial(_break, fault=fault, measure=measure),
        _mend,
        called=f"camera: {fault.value}",
        instead=NOT_OF_NOW if kind is FaultKind.CAMERA_PAST else frozenset(),
    )


def _break(rig: Rig, fault: CameraFault, measure: float) -> None:
    for name in rig.guides or tuple(CameraName):
        rig.cameras[name].break_by(fault, rig.now_s, measure=measure)


def _mend(rig: Rig) -> None:
    for camera in rig.cameras.values():
        camera.mend()


def _slow(rig: Rig) -> None:
    for name in rig.guides or tuple(CameraName):
        camera = rig.cameras[name]
        camera.break_by(CameraFault.SLOW, rig.now_s, measure=SLOW_HZ)
        camera.break_by(CameraFault.SLOW, rig.now_s + SLOWER_AFTER_S, measure=SLOWER_HZ)
