"""A camera that can be broken: the Camera port around another camera, with the faults that cameras have."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import cv2
import numpy as np

from drivers.ports import Camera
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame, Image


class CameraFault(Enum):
    """What a camera does instead of what it should; BARE is none: it shows a field without plants."""

    FROZEN = "frozen"
    BLACK = "black"
    WHITE = "white"
    UNPLUGGED = "unplugged"
    SLOW = "slow"
    SIZE = "wrong size"
    TURNED = "upside down"
    LATE = "late"
    BARE = "bare"


BLIND = frozenset({CameraFault.FROZEN, CameraFault.BLACK, CameraFault.WHITE})
"""In these a picture shows nothing that could be gone by."""


def _grey(image: Image) -> Image:
    """Without colour there is no leaf; light, motion and noise stay."""
    return np.asarray(cv2.cvtColor(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), cv2.COLOR_GRAY2BGR), np.uint8)


REPAINTED: dict[CameraFault, Callable[[Image], Image]] = {
    CameraFault.BLACK: np.zeros_like,
    CameraFault.WHITE: lambda image: np.full_like(image, np.iinfo(np.uint8).max),
    CameraFault.SIZE: lambda image: np.ascontiguousarray(image[::2, ::2]),
    CameraFault.TURNED: lambda image: np.ascontiguousarray(image[::-1, ::-1]),
    CameraFault.BARE: _grey,
}


@dataclass(frozen=True, slots=True)
class _Broken:
    """A fault from some time on; measure: seconds late, or frames a second, where it has one."""

    fault: CameraFault
    from_s: float
    until_s: float
    measure: float


class FaultyCamera:
    """Healthy until it is broken; `good_s` is the stamp of the newest frame given that one can go by."""

    def __init__(self, name: CameraName, camera: Camera) -> None:
        self._name, self._camera = name, camera
        self._broken: list[_Broken] = []
        self._given: Frame | None = None
        self._made_of: Frame | None = None
        self._still: Image | None = None
        self._next_s = 0.0
        self.good_s: float | None = None

    def break_by(
        self, fault: CameraFault, now_s: float, until_s: float = float("inf"), measure: float = 0.0
    ) -> None:
        """From now on until a time: the fault; measure: seconds late, or frames a second."""
        shows = self._given is not None and self._given.stamp_s == self.good_s
        self._still = self._given.image if self._given and shows else None
        self._broken.append(_Broken(fault, now_s, until_s, measure))

    def mend(self) -> None:
        self._broken.clear()

    def latest(self, now_s: float) -> Frame | None:
        """The newest frame as the broken camera gives it. Raises DriverError while it is unplugged."""
        broken = [each for each in self._broken if each.from_s <= now_s < each.until_s]
        faults = {each.fault for each in broken}
        if CameraFault.UNPLUGGED in faults:
            raise DriverError(f"{self._name.value} camera cannot be read", FaultKind.CAMERA_UNPLUGGED)
        late_s = max((each.measure for each in broken if each.fault is CameraFault.LATE), default=0.0)
        plain = self._camera.latest(now_s - late_s)
        if plain is None or plain is self._made_of:
            return self._given
        slow = [each.measure for each in broken if each.fault is CameraFault.SLOW]
        if slow and plain.stamp_s < self._next_s:
            return self._given
        self._next_s = plain.stamp_s + (1 / min(slow) if slow else 0.0)
        self._made_of = plain
        self._given = self._made(plain, broken)
        if not faults & BLIND:
            self.good_s = self._given.stamp_s
        return self._given

    def close(self) -> None:
        self._camera.close()

    def _made(self, plain: Frame, broken: list[_Broken]) -> Frame:
        """The frame with its picture as the faults leave it; a slow camera counts what it gives."""
        image = plain.image
        for each in broken:
            if each.fault is CameraFault.FROZEN:
                self._still = image if self._still is None else self._still
                image = self._still
            elif each.fault in REPAINTED:
                image = REPAINTED[each.fault](image)
        last = self._given
        slow = any(each.fault is CameraFault.SLOW for each in broken)
        sequence = last.sequence + 1 if slow and last else plain.sequence
        if last is not None:
            sequence = max(sequence, last.sequence + 1)
        return Frame(plain.camera, sequence, plain.stamp_s, image)
