"""The loop on the wall clock: rounds, what a person asks meanwhile, and how it ends."""

from collections.abc import Callable, Sequence

from drivers.can_log import LoggedBus
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind, Trouble
from fieldnav.mission.interruption import Interruption
from fieldnav.mission.loop import REST_S, Mission
from fieldnav.mission.operating import Operating
from fieldnav.mission.pace import Pace, RunClock
from fieldnav.mission.status_board import StatusBoard
from fieldnav.operator.request import Command, Request, Requests
from states.names import Event, text
from states.table import FINISHED

JUMPED_S = 1.0
"""Of the wall clock; a time server that sets it right takes smaller steps. Our choice."""


class Driving:
    """Ticks one mission until it is over: finished, stopped by a person, or, with `once`, at a fault."""

    def __init__(
        self,
        mission: Mission,
        operating: Operating,
        board: StatusBoard,
        bus: LoggedBus,
        requests: Sequence[Requests],
        pace: Pace,
        clock: RunClock,
        reopen_bus: Callable[[], None] = lambda: None,
    ) -> None:
        """reopen_bus: opens the bus again if it was lost; raises DriverError."""
        self._mission, self._operating, self._board, self._bus = mission, operating, board, bus
        self._requests, self._pace, self._clock = requests, pace, clock
        self._reopen_bus = reopen_bus
        self._stopped = False

    def run(self, interruption: Interruption, once: bool) -> None:
        """Drive until the end. Raises KeyboardInterrupt where a signal asked for it, the wheels at rest."""
        mission = self._mission
        try:
            self._operating.start(self._clock())
            while not (mission.over and (once or self._stopped or mission.course.machine.leaf == FINISHED)):
                now_s = self._pace.next()
                if interruption.asked and not self._stopped:
                    self._stop(now_s, "interrupted by the operator")
                self._answer(now_s)
                self._operating.tick(now_s)
                self._look_after(now_s)
        finally:
            self._come_to_rest()
        if interruption.asked:
            raise KeyboardInterrupt

    def _answer(self, now_s: float) -> None:
        for source in self._requests:
            for request in source.poll(now_s):
                self._do(now_s, request)

    def _do(self, now_s: float, request: Request) -> None:
        by = f"by {request.who}"
        match request.command:
            case Command.STATUS:
                request.reply(True, "", self._board.status(now_s, lateness_s=self._pace.worst_s))
                return
            case Command.STOP:
                self._stop(now_s, f"stopped {by}")
                refused = ""
            case Command.PAUSE:
                refused = self._operating.pause(now_s, by)
            case Command.RESUME:
                refused = self._operating.resume(now_s, by)
            case Command.RESET:
                refused = self._reset(now_s, by)
        request.reply(not refused, refused or text(self._mission.course.machine.leaf))

    def _reset(self, now_s: float, by: str) -> str:
        """A reset begins with the checks, for which the bus must be there again."""
        try:
            self._reopen_bus()
        except DriverError as error:
            return str(error)
        return self._operating.reset(now_s, by)

    def _stop(self, now_s: float, reason: str) -> None:
        self._stopped = True
        self._operating.end(now_s, reason)

    def _look_after(self, now_s: float) -> None:
        """What happens beside the mission: the log of the bus, the wall clock."""
        if self._bus.failure is not None:
            reason = str(Trouble(FaultKind.DISK_FULL, self._bus.failure))
            self._operating.break_off(now_s, Event.LATCH, reason)
            self._bus.failure = None
        jumped_s = self._clock.jumped_s()
        if abs(jumped_s) > JUMPED_S:
            self._operating.note(now_s, Trouble(FaultKind.WALL_CLOCK, f"by {jumped_s:+.1f} s"))

    def _come_to_rest(self) -> None:
        """Command zero for as long as any ramp takes, however the run ended."""
        until_s = self._clock() + REST_S
        while self._clock() < until_s and not self._mission.travel.standing:
            self._mission.wheels.stop(self._pace.next())
        self._mission.wheels.stop(self._clock())
