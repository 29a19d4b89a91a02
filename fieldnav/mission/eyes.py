"""The cameras as the loop sees them: the frames that are new, and how old the newest ones are."""

from collections.abc import Iterable, Mapping

from drivers.ports import Camera
from fieldnav.messages import CameraName, Frame


class Eyes:
    """Keeps each camera's newest frame; a frame is handed on once, and never when it has become stale."""

    def __init__(self, cameras: Mapping[CameraName, Camera], stale_s: float) -> None:
        self._cameras, self._stale_s = cameras, stale_s
        self._newest: dict[CameraName, Frame] = {}

    def look(self, now_s: float, guides: Iterable[CameraName]) -> dict[CameraName, Frame]:
        """The frames, of those cameras that guide, that are new since the last look and not stale."""
        fresh = {}
        for name in guides:
            frame = self._cameras[name].latest(now_s)
            if frame is not None and frame is not self._newest.get(name):
                self._newest[name] = frame
                if now_s - frame.stamp_s <= self._stale_s:
                    fresh[name] = frame
        return fresh

    def age_s(self, now_s: float, guides: Iterable[CameraName]) -> float | None:
        """Age of the oldest of the newest frames that guide; 0 where none does, None before the first."""
        frames = [self._newest.get(name) for name in guides]
        stamps = [frame.stamp_s for frame in frames if frame is not None]
        return None if len(stamps) < len(frames) else now_s - min(stamps, default=now_s)
