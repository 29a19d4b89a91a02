"""Whether a camera still looks where its file says, judged by the rows that it leads along."""

from dataclasses import replace

from fieldnav.messages import CameraName, Evidence
from fieldnav.perception.pose.camera_pose import sight
from fieldnav.perception.pose.pose_estimate import Departure, PoseEstimate
from fieldnav.settings.camera import CameraLimits
from states.behaviour import Step, Task
from states.names import Follow, Path

SAMPLE_M = 0.1
"""Frames so far apart count as independent; measured: the estimate then errs as it says. See PoseEstimate."""


class CameraWatch:
    """Takes in what is seen while rows are tracked; complains of each camera at most once."""

    def __init__(self, task: Task, limits: CameraLimits) -> None:
        self._task, self._limits = task, limits
        self._estimates = {
            name: PoseEstimate.of_file(camera, task.crop) for name, camera in task.cameras.items()
        }
        self._sampled_m: dict[CameraName, float] = {}
        self._told: set[CameraName] = set()

    def complaint(self, state: Path, step: Step, forward_m: float) -> Step | None:
        """The step with the evidence of a camera knocked away, when it has just become certain."""
        if step.sight is None or Follow.TRACKING not in state:
            return None
        name = step.sight.frame.camera
        if name in self._told or abs(forward_m - self._sampled_m.get(name, float("inf"))) < SAMPLE_M:
            return None
        if step.sight.centres is None:
            return None
        seen = sight(step.sight.rows, step.sight.centres, self._task.crop, self._task.cameras[name])
        if seen is None:
            return None
        self._sampled_m[name] = forward_m
        estimate = self._estimates[name] = self._estimates[name].add(seen)
        knocked = estimate.knocked(self._limits)
        if not knocked:
            return None
        self._told.add(name)
        evidence = tuple(
            Evidence(f"{departure.name} off the file's", departure.off, departure.limit, departure.unit)
            for departure in estimate.departures(self._limits)
        )
        return replace(step, event=None, evidence=evidence, reason=_reason(name, knocked))


def _reason(name: CameraName, knocked: tuple[Departure, ...]) -> str:
    off = "; ".join(f"{departure.name} {departure}" for departure in knocked)
    return f"{name.value} camera knocked: {off}"
