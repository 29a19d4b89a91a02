"""The cameras as the tape sees through them."""

from collections.abc import Mapping

from drivers.compression import compressed
from drivers.ports import Camera
from fieldnav.errors import DriverError
from fieldnav.messages import CameraName, Frame
from fieldnav.mission.tape import Tape
from fieldnav.settings.robot import Robot


def taped_cameras(
    tape: Tape, cameras: Mapping[CameraName, Camera], robot: Robot
) -> Mapping[CameraName, Camera]:
    """The same cameras, taped where anybody records; how they see is noted."""
    if not tape.runs:
        return cameras
    for name in cameras:
        tape.sees(name, robot.cameras.get(name).pinhole())
    quality = robot.recording.quality
    return {name: TapedCamera(name, camera, tape, quality) for name, camera in cameras.items()}


class TapedCamera:
    """The Camera port over another; what it gives is taped, and is the picture that the tape holds."""

    def __init__(self, name: CameraName, camera: Camera, tape: Tape, quality: int) -> None:
        """quality: of the JPEG, for frames that come without theirs."""
        self._name, self._camera, self._tape, self._quality = name, camera, tape, quality
        self._given: Frame | None = None
        self._kept: Frame | None = None

    def latest(self, now_s: float) -> Frame | None:
        """The newest frame as it is recorded."""
        try:
            frame = self._camera.latest(now_s)
        except DriverError as error:
            self._tape.lost(self._name, error)
            raise
        if frame is not None and frame is not self._given:
            self._given, self._kept = frame, compressed(frame, self._quality)
            self._tape.frame(self._kept)
        return self._kept

    def close(self) -> None:
        self._camera.close()
