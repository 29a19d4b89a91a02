"""What a person may ask of a running mission: pause, resume, reset. Each says why not, or nothing."""

from math import hypot

from fieldnav.errors import DriverError
from fieldnav.mission.loop import Mission
from states.behaviour import Step
from states.names import Event, text
from states.table import FINISHED, LANE_LEAVES

PUSHED_M = 0.15
"""A robot that has come this much further than its braking takes was moved by somebody. Our choice."""
SLOWEST_BRAKING_MPS2 = 0.6
"""Slower than the gate's ramp by a quarter. Our choice."""


class Operating:
    """Pauses, resumes and resets one mission."""

    def __init__(self, mission: Mission) -> None:
        self._mission = mission
        self._left = (0.0, 0.0)
        self._allowed_m = 0.0

    def watch(self) -> None:
        """Once a round: remember where the robot was when it was last driving by itself."""
        travel = self._mission.travel
        if self._mission.course.machine.leaf in LANE_LEAVES:
            speed_mps = hypot(travel.twist.vx_mps, travel.twist.vy_mps)
            self._left = (travel.forward_m, travel.sideways_m)
            self._allowed_m = PUSHED_M + speed_mps**2 / (2 * SLOWEST_BRAKING_MPS2)

    def pause(self, now_s: float, by: str = "by the operator") -> str:
        mission = self._mission
        if not mission.course.machine.may(Event.PAUSE):
            return f"there is nothing to pause in {text(mission.course.machine.leaf)}"
        mission.course.go(now_s, Step(event=Event.PAUSE, reason=f"paused {by}"))
        return ""

    def resume(self, now_s: float, by: str = "by the operator") -> str:
        """Go on where the mission was interrupted; also the yes to a question."""
        mission = self._mission
        if not mission.course.machine.may(Event.RESUME) or mission.course.machine.leaf in LANE_LEAVES:
            return f"there is nothing to resume in {text(mission.course.machine.leaf)}"
        if mission.wheels.taken_over:
            return "somebody else commands the wheels"
        if self._moved_m > self._allowed_m:
            return f"the robot was moved by {self._moved_m:.2f} m meanwhile: reset lets it look for its place"
        mission.course.confirmations.grant()
        mission.course.go(now_s, Step(event=Event.RESUME, reason=f"resumed {by}"))
        return ""

    def reset(self, now_s: float, by: str = "by the operator") -> str:
        """Release the modules and begin again with the checks, at the place that the ledger has."""
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
