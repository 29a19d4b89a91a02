"""Everything that is done to a mission from outside, and taped: its rounds, and what a person asks."""

from math import hypot

from fieldnav.errors import DriverError
from fieldnav.faults import Trouble
from fieldnav.journal.ledger import Booking
from fieldnav.mission.bookkeeping import place_of
from fieldnav.mission.loop import Mission
from fieldnav.mission.tape import Tape
from fieldnav.recording.records import Call
from states.behaviour import Step
from states.names import Event, text
from states.table import FINISHED, LANE_LEAVES, PAUSED

PUSHED_M = 0.15
"""A robot that has come this much further than its braking takes was moved by somebody. Our choice."""
SLOWEST_BRAKING_MPS2 = 0.6
"""Slower by a fifth than any module that is not taken for one that runs away. Our choice."""


class Operating:
    """Starts, ticks, pauses, resumes, resets and ends one mission. What is refused says why."""

    def __init__(self, mission: Mission, tape: Tape | None = None) -> None:
        self._mission, self._tape = mission, tape or Tape()
        self._left = (0.0, 0.0)
        self._allowed_m = 0.0

    def take_up(self, booking: Booking) -> None:
        """Before the start: the place from which a run that was broken off goes on. Raises FieldnavError."""
        with self._tape.round(Call.TAKE_UP, booking.stamp_s, booking=booking):
            self._mission.course.resume_from(place_of(booking))

    def start(self, now_s: float) -> None:
        with self._tape.round(Call.START, now_s):
            self._mission.start(now_s)

    def tick(self, now_s: float) -> None:
        """One round of the loop. Raises FieldnavError, see Mission.tick."""
        with self._tape.round(Call.TICK, now_s):
            self._mission.tick(now_s)
        self.watch()

    def end(self, now_s: float, reason: str) -> None:
        """Stop for good, on a person's word."""
        with self._tape.round(Call.END, now_s, reason):
            self._mission.end(now_s, reason)

    def break_off(self, now_s: float, event: Event, reason: str) -> None:
        """Stop for what lies outside the mission."""
        with self._tape.round(Call.BREAK_OFF, now_s, reason, latched=event is Event.LATCH):
            self._mission.break_off(now_s, event, reason)

    def note(self, now_s: float, trouble: Trouble) -> None:
        """Write down what changes no state."""
        with self._tape.round(Call.NOTE, now_s, trouble.said, trouble.fault):
            self._mission.note(now_s, trouble)

    def watch(self) -> None:
        """Once a round: remember where the robot was when it was last driving by itself."""
        travel = self._mission.travel
        if self._mission.course.machine.leaf in LANE_LEAVES:
            speed_mps = hypot(travel.twist.vx_mps, travel.twist.vy_mps)
            self._left = (travel.forward_m, travel.sideways_m)
            self._allowed_m = PUSHED_M + speed_mps**2 / (2 * SLOWEST_BRAKING_MPS2)

    def pause(self, now_s: float, by: str = "by the operator") -> str:
        with self._tape.round(Call.PAUSE, now_s, by):
            return self._pause(now_s, by)

    def resume(self, now_s: float, by: str = "by the operator") -> str:
        """Go on where the mission was interrupted; also the yes to a question."""
        with self._tape.round(Call.RESUME, now_s, by):
            return self._resume(now_s, by)

    def reset(self, now_s: float, by: str = "by the operator") -> str:
        """Release the modules and begin again with the checks, at the place that the ledger has."""
        with self._tape.round(Call.RESET, now_s, by):
            return self._reset(now_s, by)

    def _pause(self, now_s: float, by: str) -> str:
        mission = self._mission
        if not mission.course.machine.may(Event.PAUSE):
            return f"there is nothing to pause in {text(mission.course.machine.leaf)}"
        mission.course.go(now_s, Step(event=Event.PAUSE, reason=f"paused {by}"))
        return ""

    def _resume(self, now_s: float, by: str) -> str:
        mission = self._mission
        if not mission.course.machine.may(Event.RESUME) or mission.course.machine.leaf in LANE_LEAVES:
            return f"there is nothing to resume in {text(mission.course.machine.leaf)}"
        if mission.wheels.taken_over:
            return "somebody else commands the wheels"
        if mission.wheels.stops is not None:
            return f"{mission.wheels.stops}; see to it and resume again, or reset"
        if self._moved_m > self._allowed_m:
            return f"the robot was moved by {self._moved_m:.2f} m meanwhile: reset lets it look for its place"
        if mission.course.machine.leaf == PAUSED:
            mission.course.confirmations.grant()
        else:
            mission.course.confirmations.withdraw()  # a fault has come between the question and its answer
        mission.course.go(now_s, Step(event=Event.RESUME, reason=f"resumed {by}"))
        return ""

    def _reset(self, now_s: float, by: str) -> str:
        mission = self._mission
        if mission.course.machine.leaf == FINISHED or not mission.course.machine.may(Event.RESET):
            return f"there is nothing to reset in {text(mission.course.machine.leaf)}"
        if mission.wheels.taken_over:
            return "somebody else commands the wheels"
        try:
            mission.wheels.release_emergency_stop(now_s)
        except DriverError as error:
            return str(error)
        mission.course.confirmations.withdraw()
        mission.course.go(now_s, Step(event=Event.RESET, reason=f"reset {by}"))
        if mission.course.books.newest is not None:
            mission.course.resume_from(mission.course.books.newest)
        mission.start(now_s)
        return ""

    @property
    def _moved_m(self) -> float:
        travel = self._mission.travel
        return hypot(travel.forward_m - self._left[0], travel.sideways_m - self._left[1])
