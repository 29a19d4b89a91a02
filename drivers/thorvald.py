"""The wheel modules of a Thorvald over CAN: the Wheels port as the loop sees it.

No thread and no clock: `poll` takes in what has come and does what is due at the time it is given.
"""

import math
from collections.abc import Callable, Mapping
from contextlib import suppress

import can

from drivers.host_line import HostLine
from drivers.module_link import ASKED, Missing, ModuleLink
from drivers.module_rounds import ModuleRounds
from drivers.module_watch import check_modules, objection
from drivers.takeover import Takeover
from drivers.thorvald_protocol import Kind, Mode, RoboteqObject
from drivers.wire_layout import check_nodes
from fieldnav.errors import DriverError
from fieldnav.faults import FAULTS, FaultKind, Reaction, Trouble
from fieldnav.messages import Wheel, WheelReport, WheelSetpoint
from fieldnav.settings.robot import Robot

RETRY_S = 0.5
"""How often modules are asked how they are, and how long one has to answer; our choice."""

RELEASED_S = 0.5
"""So long after its release modules may still tell of an emergency stop that the host had set; our choice."""

TOLERANCE_S = 1e-6
"""A period that ticks fill exactly must not slip by one for the rounding of times."""


class ThorvaldWheels:
    """Four drive-and-steer modules on one bus. Raises SettingsError for a node id that the DBC file lacks."""

    def __init__(
        self,
        robot: Robot,
        bus: can.BusABC,
        listening: bool = False,
        asked: frozenset[Missing] = ASKED,
        clock: Callable[[], float] | None = None,
    ) -> None:
        """listening: nothing goes out, so that others may command the wheels; asked: see ModuleLink; clock:
        see HostLine."""
        check_nodes(robot)
        self._listening = listening
        self._line = HostLine(bus, robot.can, clock, robot.timeouts.loop_s)
        self._timeouts = robot.timeouts
        asked = frozenset() if listening else asked
        self._links = {wheel: ModuleLink(wheel, robot.modules[wheel], asked) for wheel in Wheel}
        self._by_node = {link.module.node_id: link for link in self._links.values()}
        self._rounds = ModuleRounds(self._line, self._links)
        self._started = False
        self._starting_s = 0.0
        self._asked_s = 0.0
        self._commanded_s = 0.0
        self._heartbeat_s = -math.inf
        self._takeover, self.taken_over = Takeover(), False
        self._own_stop, self._released_s = False, math.inf
        self._charge_percent: float | None = None

    @property
    def ready(self) -> bool:
        """All modules are operational and are the ones of the robot file; until then only zero is sent."""
        links = self._links.values()
        return self._started and all(map(_is_ready, links))

    @property
    def stops(self) -> Trouble | None:
        """The first module's trouble that a person must see to before anything may move."""
        return next((link.stops for link in self._links.values() if link.stops is not None), None)

    def versions(self) -> dict[Wheel, tuple[int, int, int] | None]:
        """The modules' script versions (major, minor, patch), as far as they have said them."""
        return {wheel: link.version for wheel, link in self._links.items()}

    def start(self, now_s: float) -> None:
        """Command zero and begin to bring the modules up; `poll` goes on with it until `ready`."""
        self._commanded_s = self._starting_s = now_s
        self._started = True
        for link in self._links.values():
            link.begin(now_s)
        self._rounds.drive(now_s, {})
        self._ask(now_s)
        self._beat(now_s)

    def poll(self, now_s: float) -> WheelReport:
        """Take in all frames that wait, do what is due, and check that every module is well.

        Raises DriverError for a module that is silent, has rebooted, or is not the one of the robot file,
        for a bus that is flooded or off, and for commands that somebody else begins to give.
        """
        back = self._receive(now_s)
        was_taken, self.taken_over = self.taken_over, self._takeover.lasts(now_s)
        if self._started:
            given_back = was_taken and not self.taken_over
            if given_back:
                self._forget_modes(now_s)
            asks = back or given_back or now_s - self._asked_s >= RETRY_S - TOLERANCE_S
            # A module that is set to drive goes by its newest set-point.
            sets_mode = asks and any(link.mode.value != Mode.DRIVE for link in self._links.values())
            late = now_s - self._commanded_s > self._timeouts.command_s
            if (back or late or sets_mode) and not self.taken_over:
                self._rounds.drive(now_s, {})
            if asks:
                self._ask(now_s)
            if now_s - self._heartbeat_s >= self._timeouts.heartbeat_s - TOLERANCE_S:
                self._beat(now_s)
            self._excuse_own_stop(now_s)
            self._check_modules(now_s)
        links = self._links.items()
        said = {wheel: report for wheel, link in links if (report := link.report) is not None}
        return WheelReport(said, self._charge_percent)

    def command(self, now_s: float, setpoints: Mapping[Wheel, WheelSetpoint]) -> None:
        """Send a set-point to each module; zero while not `ready` and to a wheel that is not mentioned.

        While somebody else commands the wheels nothing is sent: two hosts would make them jerk.
        Raises DriverError when a number is not finite (zero has then been sent), the bus refuses a frame (the
        other modules then have theirs), or a set-point that moves was decided too long ago.
        """
        self._commanded_s = now_s
        numbers = [number for point in setpoints.values() for number in (point.speed_mps, point.steering_rad)]
        finite = all(map(math.isfinite, numbers))
        if self.taken_over:
            return
        self._rounds.drive(now_s, setpoints if finite and self.ready else {})
        if not finite:
            raise DriverError("a wheel command is not a finite number; zero was sent instead")

    def stop(self, now_s: float) -> None:
        """Command zero speed at the present steering angles to every module it can reach; never raises."""
        with suppress(DriverError):
            self._rounds.drive(now_s, {})

    def emergency_stop(self, now_s: float) -> None:
        """Zero, then the controllers' own emergency stop. Not a safety function: the contactor is.

        Raises DriverError when a frame did not go out; all the others have then been sent.
        """
        self._own_stop, self._released_s = True, math.inf
        try:
            self._rounds.drive(now_s, {})
        finally:
            self._rounds.set(now_s, RoboteqObject.EMERGENCY_STOP)

    def release_emergency_stop(self, now_s: float) -> None:
        """Zero, then let the controllers run again; only ever on the explicit act of a person.

        Raises DriverError; when a module could not be given its zero, none is released.
        """
        self._rounds.drive(now_s, {})
        self._rounds.set(now_s, RoboteqObject.EMERGENCY_STOP_RELEASE)
        self._released_s = now_s

    def close(self) -> None:
        self._line.close()

    def _check_modules(self, now_s: float) -> None:
        try:
            check_modules(self._links.values(), now_s, self._starting_s, self._timeouts.module_s)
        except DriverError as error:
            if error.fault is FaultKind.MODULE_SILENT:
                self._line.check()  # who cannot be reached cannot be blamed for silence
            raise

    def _receive(self, now_s: float) -> bool:
        """Drain the bus; whether a module came back from silence or from a reboot."""
        back, foreign = False, ""
        for telegram in self._line.received(now_s):
            link = self._by_node.get(telegram.node)
            if self._takeover.is_command(telegram) and not self._listening:
                called = link.name if link else "the bus"
                foreign = self._takeover.note(telegram, called, now_s) or foreign
                self.taken_over = True
                self._forget_modes(now_s)
            elif telegram.kind is Kind.BATTERY_CHARGE and telegram.values:
                self._charge_percent = telegram.values["StateOfCharge"]
            elif link:
                link.take(telegram, now_s)
                back |= link.rebooted or (link.silent and link.heard_s == now_s)
        if back:
            self._starting_s = now_s
        if foreign:
            raise DriverError(foreign, FaultKind.FOREIGN_COMMAND)
        return back

    def _forget_modes(self, now_s: float) -> None:
        """Who else commanded the wheels may have set any mode: it is set and read back once that is over."""
        self._starting_s = now_s
        for link in self._links.values():
            link.mode.disregard()

    def _excuse_own_stop(self, now_s: float) -> None:
        """That the modules stand in an emergency stop which the host has set is no news."""
        if not self._own_stop:
            return
        over = now_s - self._released_s > RELEASED_S
        for link in self._links.values():
            link.excuse(over)
        self._own_stop = not over

    def _ask(self, now_s: float) -> None:
        self._asked_s = now_s
        self._rounds.ask(now_s)
        if not self.taken_over:
            self._rounds.ask_mode(now_s)

    def _beat(self, now_s: float) -> None:
        self._heartbeat_s = now_s
        self._line.beat(now_s)


def _is_ready(link: ModuleLink) -> bool:
    """Whether a module may move; what passes by itself is held for by who commands it."""
    trouble = link.trouble
    well = trouble is None or FAULTS[trouble.fault].reaction is Reaction.HOLD
    return well and link.missing is None and objection(link) is None
