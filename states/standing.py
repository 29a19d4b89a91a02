"""The states in which the wheels stand still: Idle, Checking, Paused, Fault, Finished."""

from fieldnav.messages import Bound, CameraName, Evidence
from states.behaviour import Observation, Step, Task
from states.judgement import first_of
from states.names import Event

CHECK_S = 10.0
"""Cameras and modules that have not come up by then will not."""


class Standing:
    """Waits for a person; asks for no camera and moves nothing."""

    cameras: tuple[CameraName, ...] = ()

    def step(self, seen: Observation) -> Step:
        return Step()


class Checking:
    """Both cameras must give frames of the size their file says, and the modules must be ready."""

    cameras: tuple[CameraName, ...] = tuple(CameraName)

    def __init__(self, task: Task, ready: Event = Event.READY) -> None:
        """ready: what to do when all is well: begin, or look for the place to go on."""
        self._task, self._ready = task, ready
        self._entered_s: float | None = None
        self._sizes: dict[CameraName, tuple[int, int]] = {}

    def step(self, seen: Observation) -> Step:
        if self._entered_s is None:
            self._entered_s = seen.now_s
        for name, frame in seen.frames.items():
            self._sizes[name] = (frame.image.shape[1], frame.image.shape[0])
        wrong = [name for name in CameraName if name in self._sizes and not self._fits(name)]
        waited_s = seen.now_s - self._entered_s
        evidence = (
            Evidence("cameras that give frames", len(self._sizes), len(CameraName), "cameras", self._ready),
            Evidence("wheel modules ready", float(seen.wheels_ready), 1, "", self._ready),
            Evidence(
                "cameras of another size", len(wrong), 0, "cameras", Event.FAIL, Bound.ABOVE, alone=True
            ),
            Evidence("waited", waited_s, CHECK_S, "s", Event.FAIL, Bound.ABOVE, alone=True),
        )
        if wrong:
            return Step(event=Event.FAIL, evidence=evidence, reason=self._mismatch(wrong[0]))
        event = first_of(evidence, self._ready, Event.FAIL)
        reason = "cameras or wheel modules do not come up" if event is Event.FAIL else ""
        return Step(event=event, evidence=evidence, reason=reason)

    def _fits(self, name: CameraName) -> bool:
        camera = self._task.cameras[name]
        return self._sizes[name] == (camera.width_px, camera.height_px)

    def _mismatch(self, name: CameraName) -> str:
        camera, (width, height) = self._task.cameras[name], self._sizes[name]
        return (
            f"{name.value} camera gives {width}x{height}, its file says {camera.width_px}x{camera.height_px}"
        )
