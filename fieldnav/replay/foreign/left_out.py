"""What of a recording was not looked at, in numbers."""

from collections.abc import Iterable

from fieldnav.mission.loop import TICK_S
from fieldnav.replay.foreign.camera import ForeignCamera

MUCH = 0.05
"""Of a camera's pictures: if more were not looked at, the recording was not replayed. Our choice."""


class LeftOut:
    """The pictures that no mission looked at; after one that has finished there is nothing to look at."""

    def __init__(self, cameras: Iterable[ForeignCamera], again: bool, finished: bool) -> None:
        self._cameras, self._again, self._finished = tuple(cameras), again, finished

    @property
    def much(self) -> bool:
        """Whether so many were left out that the replay says little of the recording."""
        return any(self._missed(each) > MUCH * each.counts.total for each in self._cameras)

    @property
    def said(self) -> list[str]:
        """A sentence for each camera of which something was left out."""
        return [said for camera in self._cameras for said in (self._left(camera), _overtaken(camera)) if said]

    def _missed(self, camera: ForeignCamera) -> int:
        counts = camera.counts
        after_the_end = counts.idle + (0 if camera.ended else counts.untaken)
        return counts.not_looked_at - (after_the_end if self._finished else 0)

    def _left(self, camera: ForeignCamera) -> str:
        counts = camera.counts
        if not counts.not_looked_at:
            return ""
        parts = [
            (0 if camera.ended else counts.untaken + counts.idle, self._after),
            (counts.untaken if camera.ended else 0, "that the file tells of and does not hold"),
            (counts.idle if camera.ended else 0, "while the mission stood"),
            (counts.late, "older than a picture before them"),
            (counts.damaged, "damaged"),
            (counts.dropped, "of a clock that was set"),
        ]
        reasons = ", ".join(f"{count} {why}" for count, why in parts if count)
        return (
            f"{camera.name.value} camera: {counts.not_looked_at} of {counts.total} pictures "
            f"were not looked at: {reasons}"
        )

    @property
    def _after(self) -> str:
        if self._finished:
            return "after the mission had finished (see --lanes, --again)"
        return "behind a gap" if self._again else "after the mission had stopped (see --again)"


def replayed_until(cameras: Iterable[ForeignCamera]) -> str:
    """How far a recording was replayed that turned out to be broken."""
    counts = ", ".join(f"{each.counts.taken} of {each.counts.total} {each.name.value}" for each in cameras)
    return f"pictures replayed until then: {counts}"


def _overtaken(camera: ForeignCamera) -> str:
    counts = camera.counts
    if not counts.overtaken:
        return ""
    return (
        f"{camera.name.value} camera: {counts.overtaken} of {counts.total} pictures were overtaken "
        f"by newer ones within {TICK_S:g} s, the time between two looks"
    )
