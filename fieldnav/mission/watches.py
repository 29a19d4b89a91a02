"""All that is watched over in a round of the loop, beside what the states judge and the driver raises."""

from collections.abc import Iterator
from math import radians

from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import CameraName, WheelReport
from fieldnav.mission.camera_watch import CameraWatch
from fieldnav.mission.eyes import Eyes
from fieldnav.mission.gate import Passed
from fieldnav.mission.progress import Progress
from fieldnav.mission.wheel_watch import WheelWatch
from fieldnav.settings.robot import Robot
from states.behaviour import Step, Task
from states.names import Path


class Watches:
    """Time, wheels, progress, battery, and the cameras' places and rates."""

    def __init__(self, robot: Robot, task: Task, commanding: bool) -> None:
        self.commanding = commanding
        self._loop_s = robot.timeouts.loop_s
        self._least_percent = robot.battery.least_charge
        self._camera_watch = CameraWatch(task, robot.camera_limits)
        self._wheel_watch = WheelWatch(radians(robot.limits.steering_aligned_deg), robot.geometry)
        self._progress = Progress()
        self._slow = False

    def lateness(self, before_s: float | None, now_s: float) -> Trouble | None:
        """Whether a round begins too long after the one before; what was seen then no longer holds."""
        apart_s = 0.0 if before_s is None else now_s - before_s
        if 0 <= apart_s <= self._loop_s:
            return None
        said = f"two rounds of the loop {apart_s:.2f} s apart, limit {self._loop_s:.2f} s"
        return Trouble(FaultKind.LOOP_LATE, said)

    def wheels(self, now_s: float, report: WheelReport, taken_over: bool) -> Trouble | None:
        """The first wheel that does not do what it was told; none while another commands them."""
        if taken_over or not self.commanding:
            self._wheel_watch.forget()
            return None
        return self._wheel_watch.trouble(now_s, report)

    def sent(self, now_s: float, passed: Passed) -> None:
        """Take in what went out to the wheels."""
        self._wheel_watch.sent(now_s, passed)

    def progress(self, now_s: float, passed: Passed, report: WheelReport, standing: bool) -> Trouble | None:
        """Why the mission does not get on, or should not."""
        charge = report.charge_percent
        if charge is not None and charge < self._least_percent:
            said = f"charge {charge:.0f} percent, limit {self._least_percent:.0f}"
            return Trouble(FaultKind.BATTERY_FLAT, said)
        return self._progress.trouble(now_s, passed, standing and self.commanding)

    def notes(
        self, leaf: Path, step: Step, forward_m: float, eyes: Eyes, guides: tuple[CameraName, ...]
    ) -> Iterator[tuple[str, Step]]:
        """What a person should know, as the journal's event and a step with its reason; once each."""
        knocked = self._camera_watch.complaint(leaf, step, forward_m)
        if knocked is not None:
            yield "camera knocked", knocked
        _, slow = eyes.slowness(guides)
        if slow is not None and not self._slow:
            yield slow.fault.value, Step(reason=slow.said)
        self._slow = slow is not None
