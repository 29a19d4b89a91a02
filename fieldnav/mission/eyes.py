"""The cameras as the loop sees them: the frames that are new, and how old the newest ones are."""

from collections.abc import Iterable, Mapping

from drivers.ports import Camera
from fieldnav.messages import CameraName, Frame
from fieldnav.mission.refusal import FUTURE_S


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
                if -FUTURE_S <= now_s - frame.stamp_s <= self._stale_s:
                    fresh[name] = frame
        return fresh

    def age_s(self, now_s: float, guides: Iterable[CameraName]) -> float | None:
        """The worst age of the newest frames that guide; 0 where none does, None before the first.

        A stamp in the future, a negative age, is worse than any old one.
        """
        frames = [self._newest.get(name) for name in guides]
        ages = [now_s - frame.stamp_s for frame in frames if frame is not None]
        if len(ages) < len(frames):
            return None
        youngest = min(ages, default=0.0)
        return youngest if youngest < -FUTURE_S else max(ages, default=0.0)
