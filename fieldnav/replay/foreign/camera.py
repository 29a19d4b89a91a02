"""The cameras of a recording: they give, by its stamps, the pictures that were taken then."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain, islice, pairwise
from math import inf

import numpy as np

from fieldnav.errors import DriverError, SettingsError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame, Image
from fieldnav.replay.foreign.fitting import fitted
from fieldnav.replay.foreign.shot import NS_PER_S, Shot
from fieldnav.replay.foreign.steps import LOOK_AHEAD, MAX_BACK_NS, is_step
from fieldnav.settings.camera import CameraSettings

MAX_TRIED = 30
"""Pictures at the beginning, one of which must be whole; of the usual camera two seconds. Our choice."""


@dataclass(slots=True)
class Counts:
    """The pictures of a camera: how many there are, and what became of them.

    there: as far as the file tells. taken: by their time, in order. Of these late: older than one before;
    overtaken: by a newer one within the same round of the loop; idle: while the mission stood and waited;
    damaged: looked at, and no whole picture. dropped: left behind with a clock that was then set.
    """

    there: int = 0
    taken: int = 0
    late: int = 0
    overtaken: int = 0
    idle: int = 0
    damaged: int = 0
    dropped: int = 0

    @property
    def total(self) -> int:
        """How many there are, also where the file tells of fewer."""
        return max(self.there, self.taken + self.dropped)

    @property
    def untaken(self) -> int:
        """Pictures that the replay did not come to."""
        return self.total - self.taken - self.dropped

    @property
    def not_looked_at(self) -> int:
        """Overtaken ones apart: the newest is what a robot's loop takes, too."""
        return self.untaken + self.late + self.idle + self.damaged + self.dropped


class ForeignCamera:
    """The Camera port over the pictures of a recording; `notes`: what is to be told of them, once each.

    Only `advance` reads on, so that a broken file is no fault of the mission.
    """

    def __init__(
        self, name: CameraName, settings: CameraSettings, shots: Iterator[Shot], there: int = 0, off: int = 0
    ) -> None:
        """there: how many pictures the file tells of, by at most how many it may be off.

        Raises SettingsError where there is no picture, and for first pictures that cannot be used.
        """
        self.name, self._settings = name, settings
        self.counts, self.notes, self._off = Counts(there), list[str](), off
        self._shots: Iterator[Shot] = self._looked_at(shots)
        self.next = next(self._shots, None)
        self._before: Shot | None = None
        self._newest_s = -inf
        self._due: Shot | None = None
        self._frame: Frame | None = None

    @property
    def ended(self) -> bool:
        """Whether no more comes."""
        return self.next is None

    @property
    def frames(self) -> int:
        """Pictures that the mission was given, or could have asked for."""
        return self.counts.taken - self.counts.late

    @property
    def step_ns(self) -> int:
        """From the stamp of the last picture to that of the next; 0 where they are of one stretch of time."""
        if self.next is None or self._before is None:
            return 0
        before_ns, after_ns = self._before.stamp_ns, self.next.stamp_ns
        return after_ns - before_ns if is_step(before_ns, after_ns) else 0

    @property
    def clock_set(self) -> bool:
        """Whether the step is one of the clock alone: back, or forward while the writing went on."""
        if self.next is None or self._before is None or self.step_ns == 0:
            return False
        return self.step_ns < 0 or is_step(self.next.written_ns - self._before.written_ns, self.step_ns)

    def advance(self, now_s: float, begun_ns: int, leads: bool = False) -> int:
        """Read on to the newest picture of this time; how many came. Raises SettingsError for damage.

        leads: it stops where its clock was set back; in another camera such pictures are late.
        """
        before = self.counts.taken
        while self.next is not None and not (leads and self.step_ns < 0):
            stamp_s = (self.next.stamp_ns - begun_ns) / NS_PER_S
            if stamp_s > now_s:
                break
            self._take(self.next, stamp_s, self.counts.taken > before)
            self._read_on()
        return self.counts.taken - before

    def step_over(self, begun_ns: int, back: bool) -> None:
        """Leave behind what is of the clock before a step; begun_ns: when the next stretch of time begins.

        back: the leading camera's clock was set back, and, near by, this one's if it is the same.
        """
        self._due = self._frame = None
        left = self._before_own_step() if back else inf
        while self.next is not None and left > 0 and (back or _is_long_before(self.next, begun_ns)):
            self.counts.dropped += 1
            left -= 1
            self._read_on()
        self._before = None

    def latest(self, now_s: float) -> Frame | None:
        """The newest whole picture up to which was read. Raises DriverError for one of a wrong kind."""
        shot, self._due = self._due, None
        if shot is None:
            return self._frame
        try:
            image = shot.picture()
            scaled = fitted(image, self._settings, shot.name)
        except DriverError as error:
            if error.fault is not FaultKind.CAMERA_UNPLUGGED:
                raise
            self._damaged(self.counts.taken, str(error))
            return self._frame
        jpeg = shot.jpeg if scaled is image else None
        self._frame = Frame(self.name, self.frames, self._newest_s, scaled, jpeg)
        return self._frame

    def close(self) -> None:
        """Nothing to give back."""

    def _read_on(self) -> None:
        self._before, self.next = self.next, next(self._shots, None)
        if self.next is None and self.counts.untaken <= self._off:
            self.counts.there = self.counts.taken + self.counts.dropped

    def _take(self, shot: Shot, stamp_s: float, overtakes: bool) -> None:
        self.counts.taken += 1
        if stamp_s <= self._newest_s:
            self.counts.late += 1
            return
        self.counts.overtaken += overtakes
        self._due, self._newest_s = shot, stamp_s

    def _before_own_step(self) -> int:
        """How many of the next pictures come before this camera's clock was set back, if it was."""
        if self.next is None or self.step_ns < 0:
            return 0
        coming = list(islice(self._shots, LOOK_AHEAD))
        self._shots = chain(coming, self._shots)
        stamps_ns = [self.next.stamp_ns, *(each.stamp_ns for each in coming)]
        steps = [
            number for number, (one, two) in enumerate(pairwise(stamps_ns), 1) if two < one - MAX_BACK_NS
        ]
        return steps[0] if steps else 0

    def _damaged(self, number: int, said: str) -> None:
        if self.counts.damaged == 0:
            self.notes.append(f"{self.name.value} camera: picture {number} is damaged: {said}")
        self.counts.damaged += 1

    def _looked_at(self, shots: Iterator[Shot]) -> Iterator[Shot]:
        """All pictures, once one of the first can be used; its kind and size are told."""
        tried: list[Shot] = []
        for shot in shots:
            tried.append(shot)
            try:
                image = shot.picture()
                self._describe(image, fitted(image, self._settings, shot.name))
            except DriverError as error:
                if error.fault is FaultKind.CAMERA_UNPLUGGED and len(tried) < MAX_TRIED:
                    continue
                raise SettingsError(str(error)) from error
            break
        else:
            self._refuse(tried)
        yield from chain(tried, shots)

    def _refuse(self, tried: list[Shot]) -> None:
        """None of all the pictures can be used, or there is none."""
        if tried:
            try:
                tried[0].picture()
            except DriverError as error:
                raise SettingsError(str(error)) from error
        raise SettingsError(f"--{self.name.value}: there is no picture in it; allowed is one that holds some")

    def _describe(self, image: Image, scaled: Image) -> None:
        if not np.ptp(image, axis=-1).any():
            self.notes.append(
                f"{self.name.value} camera: the first picture has no colour, by which plants are told apart"
            )
        if scaled is not image:
            (height, width), (to_height, to_width) = image.shape[:2], scaled.shape[:2]
            self.notes.append(
                f"{self.name.value} camera: {width}x{height} px scaled to {to_width}x{to_height} px"
            )


def _is_long_before(shot: Shot, begun_ns: int) -> bool:
    return shot.stamp_ns < begun_ns and is_step(shot.stamp_ns, begun_ns)


class AbsentCamera:
    """The Camera port of a camera that the recording has not."""

    def __init__(self, name: CameraName) -> None:
        self.said = f"the recording has no {name.value} camera; states that need it cannot go on"

    def latest(self, now_s: float) -> Frame | None:
        """Raises DriverError, always."""
        raise DriverError(self.said, FaultKind.CAMERA_UNPLUGGED)

    def close(self) -> None:
        """Nothing to give back."""
