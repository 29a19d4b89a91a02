"""The loop: frame to perception to state to gate, once a tick; the only place that fires the machine."""

from collections.abc import Iterable, Mapping

from drivers.ports import Camera, Wheels
from fieldnav.errors import DriverError, FieldnavError
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Frame, Motion, WheelReport
from fieldnav.mission.camera_watch import CameraWatch
from fieldnav.mission.chronicle import Chronicle
from fieldnav.mission.eyes import Eyes
from fieldnav.mission.gate import Gate, Passed
from fieldnav.mission.progress import Progress
from fieldnav.mission.tick import Observer
from fieldnav.mission.travel import Travel
from fieldnav.settings.robot import Robot
from states.behaviour import Observation, Step, Task
from states.behaviours import Behaviours
from states.machine import Change, MissionMachine
from states.names import Event
from states.table import FINISHED, LANE_LEAVES, LATCHED, RECOVERABLE

TICK_S = 0.02
"""50 Hz, the rate of the wheel commands."""
REST_S = 2.0
"""So long after its end a mission waits for the wheels to say that they stand; longer than any ramp."""
NOTHING_SENT = Passed(Motion(), {})


class Mission:
    """One mission on one robot, real or simulated."""

    def __init__(
        self,
        robot: Robot,
        task: Task,
        cameras: Mapping[CameraName, Camera],
        wheels: Wheels,
        journal: Journal,
        observers: Iterable[Observer] = (),
    ) -> None:
        self._wheels = wheels
        self._gate, self._travel, self._progress = Gate(wheels, robot), Travel(robot), Progress()
        self._eyes = Eyes(cameras, robot.timeouts.frame_s)
        self._camera_watch = CameraWatch(task, robot.camera_limits)
        self.machine = MissionMachine()
        self.behaviours = Behaviours(task)
        self._chronicle = Chronicle(journal, observers, self.behaviours, self._travel)
        self._report = WheelReport()
        self._ended_s: float | None = None
        self._now_s = 0.0

    @property
    def over(self) -> bool:
        """Whether nothing more happens without a person: the wheels say they stand, or have had time to."""
        if self._ended_s is None:
            return False
        return self._travel.standing or self._now_s - self._ended_s > REST_S

    def start(self, now_s: float) -> None:
        """Bring the wheels up and begin with the checks."""
        try:
            self._wheels.start(now_s)
        except DriverError as error:
            self._go(now_s, Step(event=Event.START))
            self.break_off(now_s, Event.LATCH, str(error))
            return
        change = self._go(now_s, Step(event=Event.START))
        self._chronicle.tell(now_s, self.machine.leaf, change, Step(), NOTHING_SENT)

    def tick(self, now_s: float) -> None:
        """One round of the loop; times must rise. Whatever goes wrong, the wheels are stopped first.

        Raises FieldnavError for what is not the robot's fault: a full disk, an error in the program.
        """
        self._now_s = now_s
        try:
            self._round(now_s)
        except DriverError as error:
            self.break_off(now_s, Event.LATCH, str(error))
        except FieldnavError as error:
            self.break_off(now_s, Event.LATCH, str(error))
            raise
        except Exception as error:
            reason = f"{type(error).__name__}: {error}"
            self.break_off(now_s, Event.LATCH, reason)
            raise FieldnavError(f"the mission broke off: {reason}") from error

    def break_off(self, now_s: float, event: Event, reason: str) -> None:
        """Stop the wheels, then go to a fault state and say why."""
        self._wheels.stop(now_s)
        self._report = WheelReport()  # what the wheels do is no longer known
        self._travel.measure(now_s, self._report)
        step = Step(event=event, reason=reason)
        change = self._go(now_s, step) if self.machine.may(event) else None
        self._chronicle.tell(now_s, self.machine.leaf, change, step, NOTHING_SENT)

    def _round(self, now_s: float) -> None:
        self._report = self._wheels.poll(now_s)
        self._travel.measure(now_s, self._report)
        guides = self.behaviours.current.cameras
        frames = self._eyes.look(now_s, guides)
        step = self.behaviours.current.step(self._observe(now_s, frames))
        warning = self._note_knocked(now_s, step)
        change = self._go(now_s, step) if step.event is not None else None
        moving = self.machine.leaf in LANE_LEAVES
        motion = step.motion if moving else Motion()
        passed = self._gate.pass_on(now_s, motion, moving, self._eyes.age_s(now_s, guides), self._report)
        self._chronicle.held(now_s, self.machine.leaf, passed)
        complaint = self._progress.complaint(now_s, passed, self._travel.standing)
        if complaint and change is None and moving:
            change = self._go(now_s, Step(event=Event.FAIL, reason=complaint))
        self._chronicle.tell(now_s, self.machine.leaf, change, step, passed, warning)

    def _observe(self, now_s: float, frames: Mapping[CameraName, Frame]) -> Observation:
        return Observation(
            now_s=now_s,
            frames=frames,
            forward_m=self._travel.forward_m,
            sideways_m=self._travel.sideways_m,
            stopped=self._travel.standing,
            wheels_aligned=self._gate.aligned,
            wheels_ready=self._wheels.ready,
            pose=self._travel.pose,
            exposed={name: self._travel.pose_at(frame.stamp_s) for name, frame in frames.items()},
        )

    def _go(self, now_s: float, step: Step) -> Change:
        """Fire, write it down, take up the new state: the journal is on the disk before the wheels obey."""
        assert step.event is not None, "only an event changes the state"
        change = self.machine.fire(step.event)
        self._chronicle.changed(now_s, change, step)
        self.behaviours.enter(change)
        ended = change.target in (FINISHED, RECOVERABLE, LATCHED)
        self._ended_s = now_s if ended else None
        return change

    def _note_knocked(self, now_s: float, step: Step) -> str:
        """Write down, once a camera, that the rows show it knocked away; the state stays as it is."""
        leaf = self.machine.leaf
        found = self._camera_watch.complaint(leaf, step, self._travel.forward_m)
        if found is None:
            return ""
        self._chronicle.noted(now_s, "camera knocked", leaf, found)
        return found.reason
