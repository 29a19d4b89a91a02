"""Taking some frames of all cameras at once, as the mission does: two may share what one has to itself."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from drivers.ports import Camera
from fieldnav.errors import DriverError
from fieldnav.messages import CameraName, Frame
from fieldnav.preflight.waiting import Watch

FRAMES = 8
PATIENCE_S = 3.0
"""A webcam gives its first frame after up to two seconds."""
POLL_S = 0.005


@dataclass(slots=True)
class Taken:
    """A camera's frames in their order, and why there are no more, empty while there may be."""

    frames: list[Frame] = field(default_factory=list)
    failure: str = ""

    @property
    def done(self) -> bool:
        return bool(self.failure) or len(self.frames) >= FRAMES


def sample(cameras: Mapping[CameraName, Camera], watch: Watch) -> dict[CameraName, Taken]:
    """Frames as they come, until there are enough of each camera or patience is at its end."""
    taken = {name: Taken() for name in cameras}
    until_s = watch.clock() + PATIENCE_S
    while watch.clock() < until_s:
        due = [name for name in cameras if not taken[name].done]
        if not due:
            break
        came = [_take(name, cameras[name], taken[name], watch.clock()) for name in due]
        if not any(came):
            watch.wait(POLL_S)
    return taken


def _take(name: CameraName, camera: Camera, taken: Taken, now_s: float) -> bool:
    """Take the camera's newest frame; whether it is a new one."""
    try:
        frame = camera.latest(now_s)
    except DriverError as error:
        taken.failure = str(error).removeprefix(f"{name.value} camera: ")
        return False
    if frame is None or (taken.frames and frame is taken.frames[-1]):
        return False
    taken.frames.append(frame)
    return True
