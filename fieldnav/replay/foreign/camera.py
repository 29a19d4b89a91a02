"""The cameras of a recording: they give, by its stamps, the pictures that were taken then."""

from collections.abc import Iterator
from math import inf

from fieldnav.errors import DriverError, SettingsError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame
from fieldnav.replay.foreign.fitting import fitted
from fieldnav.replay.foreign.shot import NS_PER_S, Shot
from fieldnav.settings.camera import CameraSettings


class ForeignCamera:
    """The Camera port over the pictures of a recording; `said`: what is to be told of them, once.

    Only `advance` reads on, so that a broken file is no fault of the mission.
    """

    def __init__(self, name: CameraName, settings: CameraSettings, shots: Iterator[Shot]) -> None:
        """Raises SettingsError for a first picture that cannot be used, and where there is none."""
        self._name, self._settings, self._shots = name, settings, shots
        self._next = next(shots, None)
        if self._next is None:
            raise SettingsError(f"--{name.value}: there is no picture in it; allowed is one that holds some")
        self.first_ns = self._next.stamp_ns
        self.said = self._first_look(self._next)
        self.frames = 0
        self._newest_s = -inf
        self._due: Shot | None = None
        self._frame: Frame | None = None

    @property
    def ended(self) -> bool:
        """Whether no more comes."""
        return self._next is None

    def advance(self, now_s: float, begun_ns: int) -> None:
        """Read on to the newest picture of this time. Raises SettingsError where the file is broken."""
        while self._next is not None:
            stamp_s = (self._next.stamp_ns - begun_ns) / NS_PER_S
            if stamp_s > now_s:
                return
            if stamp_s > self._newest_s:  # one that comes too late is passed over
                self._due, self._newest_s = self._next, stamp_s
                self.frames += 1
            self._next = next(self._shots, None)

    def latest(self, now_s: float) -> Frame | None:
        """The newest picture up to which was read. Raises DriverError for one that cannot be used."""
        shot, self._due = self._due, None
        if shot is not None:
            image = shot.picture()
            scaled = fitted(image, self._settings, shot.name)
            jpeg = shot.jpeg if scaled is image else None
            self._frame = Frame(self._name, self.frames, self._newest_s, scaled, jpeg)
        return self._frame

    def close(self) -> None:
        """Nothing to give back."""

    def _first_look(self, shot: Shot) -> str:
        """That pictures are scaled, where they are. Raises SettingsError for one that cannot be used."""
        try:
            image = shot.picture()
            scaled = fitted(image, self._settings, shot.name)
        except DriverError as error:
            raise SettingsError(str(error)) from error
        if scaled is image:
            return ""
        (height, width), (to_height, to_width) = image.shape[:2], scaled.shape[:2]
        return f"{self._name.value} camera: {width}x{height} px scaled to {to_width}x{to_height} px"


class AbsentCamera:
    """The Camera port of a camera that the recording has not."""

    def __init__(self, name: CameraName) -> None:
        self.said = f"the recording has no {name.value} camera; states that need it cannot go on"

    def latest(self, now_s: float) -> Frame | None:
        """Raises DriverError, always."""
        raise DriverError(self.said, FaultKind.CAMERA_UNPLUGGED)

    def close(self) -> None:
        """Nothing to give back."""
