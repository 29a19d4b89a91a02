"""The loop: frame to perception to state to gate, once a tick; the only place that fires the machine."""

from collections.abc import Iterable, Mapping
from math import hypot

from drivers.ports import Camera, Wheels
from fieldnav.control.kinematics import body_twist
from fieldnav.errors import DriverError
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Frame, Motion, Twist, WheelReport, WheelSetpoint
from fieldnav.mission.gate import Gate, Passed
from fieldnav.mission.tick import Observer, Tick
from fieldnav.settings.robot import Robot
from states.behaviour import Observation, Step, Task
from states.behaviours import Behaviours
from states.machine import Change, MissionMachine
from states.names import Event, text
from states.table import FINISHED, LANE_LEAVES, LATCHED, RECOVERABLE

TICK_S = 0.02
"""50 Hz, the rate of the wheel commands."""
REFUSED_LIMIT_S = 2.0
"""The gate may refuse to move for so long before it counts as a fault."""
STANDING = Passed(Motion(), {})
STANDING_MPS = 0.01
STANDING_RPS = 0.01


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
        self._robot, self._cameras, self._wheels, self._journal = robot, cameras, wheels, journal
        self._observers = tuple(observers)
        self._gate = Gate(wheels, robot)
        self.machine = MissionMachine()
        self.behaviours = Behaviours(task)
        self._seen: dict[CameraName, Frame] = {}
        self._ticked_s: float | None = None
        self._twist = Twist()
        self._refused_since_s: float | None = None
        self._report = WheelReport()
        self._forward_m = self._sideways_m = 0.0

    @property
    def over(self) -> bool:
        """Whether nothing more happens without a person, and the robot stands."""
        return self.machine.leaf in (FINISHED, RECOVERABLE, LATCHED) and self._standing

    def start(self, now_s: float) -> None:
        """Bring the wheels up and begin with the checks."""
        self._wheels.start(now_s)
        self._go(now_s, Event.START, Step())

    def tick(self, now_s: float) -> None:
        """One round of the loop; times must rise."""
        try:
            self._report = self._wheels.poll(now_s)
            frames = self._look(now_s)
        except DriverError as error:
            change = self._fail(now_s, Event.LATCH, str(error))
            self._wheels.stop(now_s)
            self._report, self._twist = WheelReport(), Twist()  # what the wheels do is no longer known
            self._tell(now_s, change, Step(reason=str(error)), STANDING)
            return
        self._measure(now_s)
        guides = self.behaviours.current.cameras
        step = self.behaviours.current.step(self._observe(now_s, frames))
        change = None
        if step.event is not None:
            change = self._go(now_s, step.event, step)
        moving = self.machine.leaf in LANE_LEAVES
        motion = step.motion if moving else Motion()
        passed = self._gate.pass_on(now_s, motion, moving, self._age_s(now_s, guides), self._report)
        if self._refused_too_long(now_s, passed) and change is None:
            change = self._fail(now_s, Event.FAIL, f"the gate does not let the wheels move: {passed.reason}")
        self._tell(now_s, change, step, passed)

    def _look(self, now_s: float) -> dict[CameraName, Frame]:
        """The frames, of those cameras that guide, that are new since the last tick."""
        fresh = {}
        for name in self.behaviours.current.cameras:
            frame = self._cameras[name].latest(now_s)
            if frame is not None and frame is not self._seen.get(name):
                self._seen[name] = fresh[name] = frame
        return fresh

    def _measure(self, now_s: float) -> None:
        """Add up what the wheels say they have travelled."""
        modules = self._report.modules
        states = {wheel: WheelSetpoint(said.speed_mps, said.steering_rad) for wheel, said in modules.items()}
        if len(states) == len(self._robot.modules):
            self._twist = body_twist(states, self._robot.geometry)
        dt_s = 0.0 if self._ticked_s is None else now_s - self._ticked_s
        self._ticked_s = now_s
        self._forward_m += self._twist.vx_mps * dt_s
        self._sideways_m += self._twist.vy_mps * dt_s

    def _observe(self, now_s: float, frames: Mapping[CameraName, Frame]) -> Observation:
        return Observation(
            now_s=now_s,
            frames=frames,
            forward_m=self._forward_m,
            sideways_m=self._sideways_m,
            stopped=self._standing,
            wheels_aligned=self._gate.aligned,
            wheels_ready=self._wheels.ready,
        )

    @property
    def _standing(self) -> bool:
        speed_mps = hypot(self._twist.vx_mps, self._twist.vy_mps)
        return speed_mps < STANDING_MPS and abs(self._twist.yaw_rate_rps) < STANDING_RPS

    def _age_s(self, now_s: float, guides: Iterable[CameraName]) -> float | None:
        """Age of the oldest of the newest frames that guide; 0 where none does, None before the first."""
        stamps = [self._seen[name].stamp_s if name in self._seen else None for name in guides]
        known = [stamp_s for stamp_s in stamps if stamp_s is not None]
        return None if len(known) < len(stamps) else now_s - min(known, default=now_s)

    def _refused_too_long(self, now_s: float, passed: Passed) -> bool:
        if passed.reason is None:
            self._refused_since_s = None
            return False
        if self._refused_since_s is None:
            self._refused_since_s = now_s
        return now_s - self._refused_since_s > REFUSED_LIMIT_S and self.machine.may(Event.FAIL)

    def _fail(self, now_s: float, event: Event, reason: str) -> Change | None:
        """Go to a fault state, unless a fault is what the mission is in already."""
        if self.machine.leaf == LATCHED or not self.machine.may(event):
            return None
        return self._go(now_s, event, Step(event=event, reason=reason))

    def _go(self, now_s: float, event: Event, step: Step) -> Change:
        """Fire, write it down, take up the new state: the journal is on the disk before the wheels obey."""
        change = self.machine.fire(event)
        lane = self.behaviours.lane
        entry = Entry(
            stamp_s=now_s,
            event=event.value,
            source=text(change.source),
            target=text(change.target),
            lane=lane.number,
            rows=lane.rows,
            evidence=step.evidence,
            frame=step.sight.frame if step.sight else None,
            command=step.motion.twist if self.machine.leaf in LANE_LEAVES else Motion().twist,
            reason=step.reason,
        )
        self._journal.record(entry)
        self.behaviours.enter(change)
        return change

    def _tell(self, now_s: float, change: Change | None, step: Step, passed: Passed) -> None:
        lane = self.behaviours.lane
        tick = Tick(
            now_s,
            self.machine.leaf,
            change,
            step,
            passed,
            lane.number,
            lane.rows,
            lane.rows_passed,
            self._forward_m,
            self._sideways_m,
        )
        for observer in self._observers:
            observer.watch(tick)
