"""A camera that can be broken: the Camera port around another camera, with the faults that cameras have."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
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
    CLOCK = "frozen, with a running clock in the picture"
    IN_TURN = "two old pictures in turn"
    OLD = "old pictures with new stamps"
    BLACK = "black"
    WHITE = "white"
    COLOURLESS = "without colour"
    MUDDY = "mud on the lens"
    ONE_PIXEL = "one pixel blown up"
    UNPLUGGED = "unplugged"
    SLOW = "slow"
    SIZE = "wrong size"
    TURNED = "upside down"
    LATE = "late"
    BARE = "bare"


STILL = frozenset({CameraFault.FROZEN, CameraFault.CLOCK, CameraFault.IN_TURN})
BLIND = STILL | {
    CameraFault.BLACK,
    CameraFault.WHITE,
    CameraFault.COLOURLESS,
    CameraFault.MUDDY,
    CameraFault.ONE_PIXEL,
}
"""In these a picture shows nothing that could be gone by."""
MUD_BGR, MUD_NOISE = (40, 60, 85), 2.0
CLOCK_PX = (60, 20)
"""Width and height of the clock in the upper left corner."""
TURN_S = 0.4
"""Between the two old pictures that are given in turn."""
KEPT_S = 5.0
"""Pictures are kept for so long, to be given again."""


def _grey(image: Image) -> Image:
    """As a camera by night: light, motion and noise stay."""
    return np.asarray(cv2.cvtColor(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), cv2.COLOR_GRAY2BGR), np.uint8)


def _bare(image: Image) -> Image:
    """Leaves of the soil's colour: light, motion and noise stay."""
    blue, green, red = cv2.split(image)
    return np.asarray(
        cv2.merge((blue, np.minimum(green, cv2.addWeighted(blue, 0.5, red, 0.5, 0)), red)), np.uint8
    )


def _mud(image: Image) -> Image:
    """The same brown everywhere, and a sensor's noise, which the picture itself seeds."""
    random = np.random.default_rng(int(image[::16, ::16].sum()))
    noise = random.normal(0.0, MUD_NOISE, image.shape)
    return np.clip(np.array(MUD_BGR) + noise, 0, np.iinfo(np.uint8).max).astype(np.uint8)


def _one_pixel(image: Image) -> Image:
    height, width = image.shape[:2]
    return np.broadcast_to(image[height // 2, width // 2], image.shape).copy()


REPAINTED: dict[CameraFault, Callable[[Image], Image]] = {
    CameraFault.BLACK: np.zeros_like,
    CameraFault.WHITE: lambda image: np.full_like(image, np.iinfo(np.uint8).max),
    CameraFault.COLOURLESS: _grey,
    CameraFault.MUDDY: _mud,
    CameraFault.ONE_PIXEL: _one_pixel,
    CameraFault.SIZE: lambda image: np.ascontiguousarray(image[::2, ::2]),
    CameraFault.TURNED: lambda image: np.ascontiguousarray(image[::-1, ::-1]),
    CameraFault.BARE: _bare,
}


@dataclass(frozen=True, slots=True)
class _Broken:
    """A fault from some time on; measure: seconds late, or frames a second."""

    fault: CameraFault
    from_s: float
    until_s: float
    measure: float

    @property
    def delay_s(self) -> float:
        """By how much a picture is older than its stamp."""
        return self.measure if self.fault is CameraFault.OLD else 0.0


class FaultyCamera:
    """Healthy until it is broken; `good_s` is the stamp of the newest frame given that one can go by."""

    def __init__(self, name: CameraName, camera: Camera) -> None:
        self._name, self._camera = name, camera
        self._broken: list[_Broken] = []
        self._given: Frame | None = None
        self._made_of: Frame | None = None
        self._taken: deque[tuple[float, Frame]] = deque()
        self._still: tuple[Image, ...] = ()
        self._next_s = 0.0
        self.good_s: float | None = None

    def break_by(
        self, fault: CameraFault, now_s: float, until_s: float = float("inf"), measure: float = 0.0
    ) -> None:
        """From now on until a time: the fault; measure: seconds late, or frames a second."""
        if self._taken:
            newest_s = self._taken[-1][1].stamp_s
            earlier_s = newest_s - (TURN_S if fault is CameraFault.IN_TURN else 0.0)
            self._still = (self._at(newest_s).image, self._at(earlier_s).image)
        self._broken.append(_Broken(fault, now_s, until_s, measure))

    def mend(self) -> None:
        self._broken.clear()

    def take(self, now_s: float) -> None:
        """Look on, as a camera does whether it is asked or not: what it has seen it may give later."""
        plain = self._camera.latest(now_s)
        if plain is not None and not (self._taken and plain is self._taken[-1][1]):
            self._taken.append((now_s, plain))
            while now_s - self._taken[0][0] > KEPT_S:
                self._taken.popleft()

    def latest(self, now_s: float) -> Frame | None:
        """The newest frame as the broken camera gives it. Raises DriverError while it is unplugged."""
        broken = [each for each in self._broken if each.from_s <= now_s < each.until_s]
        faults = {each.fault for each in broken}
        if CameraFault.UNPLUGGED in faults:
            raise DriverError(f"{self._name.value} camera cannot be read", FaultKind.CAMERA_UNPLUGGED)
        late_s = max((each.measure for each in broken if each.fault is CameraFault.LATE), default=0.0)
        self.take(now_s)
        plain = next((frame for came_s, frame in reversed(self._taken) if came_s <= now_s - late_s), None)
        if plain is None or plain is self._made_of:
            return self._given
        slow = [each.measure for each in broken if each.fault is CameraFault.SLOW]
        if slow and plain.stamp_s < self._next_s:
            return self._given
        self._next_s = plain.stamp_s + (1 / min(slow) if slow else 0.0)
        self._made_of = plain
        shown = self._at(plain.stamp_s - max((each.delay_s for each in broken), default=0.0))
        self._given = self._made(plain, shown.image, broken)
        if not faults & BLIND:
            self.good_s = shown.stamp_s
        return self._given

    def _at(self, stamp_s: float) -> Frame:
        """The newest frame taken by a time, the oldest kept where none is so old."""
        return next(
            (frame for _, frame in reversed(self._taken) if frame.stamp_s <= stamp_s), self._taken[0][1]
        )

    def close(self) -> None:
        self._camera.close()

    def _made(self, plain: Frame, image: Image, broken: list[_Broken]) -> Frame:
        """The frame with the picture as the faults leave it; a slow camera counts what it gives."""
        last = self._given
        slow = any(each.fault is CameraFault.SLOW for each in broken)
        sequence = last.sequence + 1 if slow and last else plain.sequence
        if last is not None:
            sequence = max(sequence, last.sequence + 1)
        for each in broken:
            if each.fault in STILL:
                self._still = self._still or (image, image)
                image = self._still[sequence % len(self._still)]
                image = _with_clock(image, sequence) if each.fault is CameraFault.CLOCK else image
            elif each.fault in REPAINTED:
                image = REPAINTED[each.fault](image)
        return replace(plain, sequence=sequence, image=image, jpeg=None if broken else plain.jpeg)


def _with_clock(image: Image, count: int) -> Image:
    """The picture with a bar that grows and starts over, in a box of its own."""
    width, height = CLOCK_PX
    shown = image.copy()
    shown[:height, :width] = 0
    shown[:height, : 1 + count % width] = np.iinfo(np.uint8).max
    return shown
