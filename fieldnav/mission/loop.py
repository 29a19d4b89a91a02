"""The loop: frame to perception to state to gate, once a tick."""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from math import inf

from drivers.ports import Camera, Wheels
from fieldnav.errors import DriverError, FieldnavError, OutputError
from fieldnav.faults import FaultKind, Reaction, Trouble
from fieldnav.journal.ledger import Ledger
from fieldnav.messages import CameraName, Frame, Motion, WheelReport
from fieldnav.mission.chronicle import APART_S, Recorded
from fieldnav.mission.course import Course
from fieldnav.mission.eyes import Eyes
from fieldnav.mission.gate import Gate, Passed
from fieldnav.mission.refusal import blind
from fieldnav.mission.tick import Observer
from fieldnav.mission.travel import Travel
from fieldnav.mission.watches import Watches
from fieldnav.operator.confirmation import Confirmations
from fieldnav.settings.robot import Robot
from states.behaviour import Observation, Step, Task
from states.names import Event

TICK_S = 0.02
"""50 Hz, the rate of the wheel commands."""
REST_S = 2.0
"""So long after its end a mission waits for the wheels to say that they stand; longer than any ramp."""
NOTHING_SENT = Passed(Motion(), {})

EVENTS = {
    Reaction.PAUSE: Event.PAUSE,
    Reaction.HOLD: Event.FAIL,
    Reaction.STOP: Event.FAIL,
    Reaction.LATCH: Event.LATCH,
}
"""What a reaction means to the machine; a fault that is held and does not pass ends as a recoverable stop."""


class Mission:
    """One mission on one robot, real or simulated."""

    def __init__(
        self,
        robot: Robot,
        task: Task,
        cameras: Mapping[CameraName, Camera],
        wheels: Wheels,
        journal: Recorded,
        observers: Iterable[Observer] = (),
        ledger: Ledger | None = None,
        confirmations: Confirmations | None = None,
        commanding: bool = True,
    ) -> None:
        """commanding: False in a dry run, whose wheels do not do what they are told."""
        self.wheels = wheels
        self._gate, self.travel = Gate(wheels, robot), Travel(robot)
        self._eyes = Eyes(cameras, task.cameras, robot)
        self._watches = Watches(robot, task, commanding)
        self.course = Course(task, self.travel, journal, observers, ledger, confirmations)
        self._frame_s = robot.timeouts.frame_s
        self._now_s: float | None = None
        self._reacted_s: dict[FaultKind, float] = {}

    @property
    def commanding(self) -> bool:
        """Whether the wheels do what they are told, so that one that does not is at fault."""
        return self._watches.commanding

    @commanding.setter
    def commanding(self, commanding: bool) -> None:
        self._watches.commanding = commanding

    @property
    def over(self) -> bool:
        """Whether nothing more happens without a person: the wheels say they stand, or have had time to."""
        if self.course.ended_s is None or self._now_s is None:
            return False
        return self.travel.standing or self._now_s - self.course.ended_s > REST_S

    def start(self, now_s: float) -> None:
        """Bring the wheels up and begin with the checks."""
        self._eyes.forget()
        try:
            self.wheels.start(now_s)
        except DriverError as error:
            self.course.go(now_s, Step(event=Event.START))
            self.react(now_s, Trouble(error.fault, str(error)))
            return
        change = self.course.go(now_s, Step(event=Event.START))
        self.course.chronicle.tell(now_s, self.course.leaf, change, Step(), NOTHING_SENT)

    def tick(self, now_s: float) -> None:
        """One round of the loop; times must rise. Whatever goes wrong, the wheels are stopped first.

        Raises FieldnavError for what is not the robot's fault: a full disk, an error in the program.
        """
        before_s, self._now_s = self._now_s, now_s
        try:
            late = self._watches.lateness(before_s, now_s)
            if late is not None and self.course.moving:
                self.react(now_s, late)
            self._round(now_s)
        except DriverError as error:
            self.react(now_s, Trouble(error.fault, str(error)))
        except FieldnavError as error:
            fault = FaultKind.DISK_FULL if isinstance(error, OutputError) else FaultKind.PROGRAM
            self.react(now_s, Trouble(fault, str(error)))
            raise
        except Exception as error:
            reason = f"{type(error).__name__}: {error}"
            self.react(now_s, Trouble(FaultKind.PROGRAM, reason))
            raise FieldnavError(f"the mission broke off: {reason}") from error

    def react(self, now_s: float, trouble: Trouble) -> None:
        """Do what the table of faults declares; what changes no state is written down once it begins."""
        if trouble.fault is FaultKind.DRIVE_RUNAWAY:  # zero alone is what that wheel does not obey
            with suppress(DriverError):
                self.wheels.emergency_stop(now_s)
        event = EVENTS[trouble.reaction]
        changes = self.course.machine.may(event)
        self.break_off(now_s, event, str(trouble))
        last_s = self._reacted_s.get(trouble.fault, -inf)
        self._reacted_s[trouble.fault] = now_s
        if not changes and now_s - last_s > APART_S:
            self.note(now_s, trouble)

    def end(self, now_s: float, reason: str) -> None:
        """Stop for good on a person's word, from whatever state."""
        self.break_off(now_s, Event.FAIL, reason)
        self.course.ended_s = now_s

    def note(self, now_s: float, trouble: Trouble) -> None:
        """Write down what changes no state."""
        self.course.chronicle.noted(now_s, trouble.fault.value, self.course.leaf, Step(reason=trouble.said))

    def break_off(self, now_s: float, event: Event, reason: str) -> None:
        """Stop the wheels, then go to a state that stands and say why."""
        self.wheels.stop(now_s)
        self._gate.halted()
        self._watches.sent(now_s, NOTHING_SENT)
        self.travel.measure(now_s, WheelReport())  # what the wheels do is no longer known
        step = Step(event=event, reason=reason)
        change = self.course.go(now_s, step) if self.course.machine.may(event) else None
        self.course.chronicle.tell(now_s, self.course.leaf, change, step, NOTHING_SENT)

    def _round(self, now_s: float) -> None:
        report = self.wheels.poll(now_s)
        self.travel.measure(now_s, report)
        disobedient = self._watches.wheels(now_s, report, self.wheels.taken_over)
        if disobedient is not None:
            self.react(now_s, disobedient)
            return
        guides = self.course.behaviours.current.cameras
        frames = self._eyes.look(now_s, guides, self.travel.track, self.travel.heard)
        step = self.course.asked(self.course.behaviours.current.step(self._observe(now_s, frames)))
        step = self._explained(now_s, step, guides)
        warning = self._noted(now_s, step, guides)
        change = self.course.go(now_s, step) if step.event is not None else None
        moving = self.course.moving
        self.course.books.travelled(now_s, self.course.leaf)
        motion = self._eyes.slowed(step.motion, guides) if moving else Motion()
        try:
            passed = self._gate.pass_on(now_s, motion, moving, self._eyes.sight(now_s, guides), report)
        except DriverError:
            if change is not None:
                self.course.chronicle.tell(now_s, self.course.leaf, change, step, NOTHING_SENT, warning)
            raise
        self._watches.sent(now_s, passed if self.wheels.ready else NOTHING_SENT)
        self.course.chronicle.held(now_s, self.course.leaf, passed)
        trouble = self._watches.progress(now_s, passed, report, self.travel.standing)
        if trouble and change is None and moving:
            self.react(now_s, trouble)
            return
        self.course.chronicle.tell(now_s, self.course.leaf, change, step, passed, warning)

    def _observe(self, now_s: float, frames: Mapping[CameraName, Frame]) -> Observation:
        return Observation(
            now_s=now_s,
            frames=frames,
            forward_m=self.travel.forward_m,
            sideways_m=self.travel.sideways_m,
            stopped=self.travel.standing,
            wheels_aligned=self._gate.aligned,
            wheels_ready=self.wheels.ready,
            pose=self.travel.pose,
            exposed=self._eyes.exposed(frames, self.travel.track),
        )

    def _explained(self, now_s: float, step: Step, guides: tuple[CameraName, ...]) -> Step:
        """A failure with what is wrong with the cameras, where they do not show anything."""
        if step.event is not Event.FAIL:
            return step
        trouble = blind(self._eyes.sight(now_s, guides), self._frame_s)
        return step if trouble is None else replace(step, reason=f"{trouble}; {step.reason}")

    def _noted(self, now_s: float, step: Step, guides: tuple[CameraName, ...]) -> str:
        """Write down, once each, what a person should know and what changes no state."""
        leaf = self.course.leaf
        warnings = []
        for event, found in self._watches.notes(leaf, step, self.travel.forward_m, self._eyes, guides):
            self.course.chronicle.noted(now_s, event, leaf, found)
            warnings.append(found.reason)
        return "; ".join(warnings)
