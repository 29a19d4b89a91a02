"""The wheel modules of a Thorvald over CAN: the Wheels port as the loop sees it.

No thread and no clock: `poll` takes in what has come and does what is due at the time it is given.
"""

import math
from collections.abc import Mapping
from contextlib import suppress

import can

from drivers.host_line import HostLine
from drivers.module_link import Missing, ModuleLink
from drivers.thorvald_protocol import RoboteqObject
from fieldnav.errors import DriverError
from fieldnav.messages import Wheel, WheelReport, WheelSetpoint
from fieldnav.settings.robot import Robot

RETRY_S = 0.5
"""How long a module has to answer before it is asked again; our choice."""

START_LIMIT_S = 5.0
"""How long bringing up may take: twice the 2 s in which TPDO4 tells both its parts, and one; our choice."""

TOLERANCE_S = 1e-6
"""A period that ticks fill exactly must not slip by one for the rounding of times."""


class ThorvaldWheels:
    """Four drive-and-steer modules on one bus. Raises DriverError for a node id that the DBC file lacks."""

    def __init__(self, robot: Robot, bus: can.BusABC) -> None:
        self._line = HostLine(bus)
        self._timeouts = robot.timeouts
        self._links = {wheel: ModuleLink(wheel, robot.modules[wheel]) for wheel in Wheel}
        self._by_node = {link.module.node_id: link for link in self._links.values()}
        for link in self._links.values():
            if link.module.node_id not in self._line.nodes:
                allowed = ", ".join(map(str, sorted(self._line.nodes)))
                raise DriverError(f"{link.name}: the wire layout thorvald.dbc has only nodes {allowed}")
        self._started = False
        self._starting_s = 0.0
        self._asked_s = 0.0
        self._commanded_s = 0.0
        self._heartbeat_s = -math.inf

    @property
    def ready(self) -> bool:
        """All modules are operational and are the ones of the robot file; until then only zero is sent."""
        links = self._links.values()
        return self._started and all(link.missing is None and link.objection is None for link in links)

    def versions(self) -> dict[Wheel, tuple[int, int, int] | None]:
        """The modules' script versions (major, minor, patch), as far as they have said them."""
        return {wheel: link.version for wheel, link in self._links.items()}

    def start(self, now_s: float) -> None:
        """Command zero and begin to bring the modules up; `poll` goes on with it until `ready`."""
        self._commanded_s = self._starting_s = now_s
        self._started = True
        for link in self._links.values():
            link.begin(now_s)
        self._send(now_s, {})
        self._ask(now_s)
        self._beat(now_s)

    def poll(self, now_s: float) -> WheelReport:
        """Take in all frames that wait, do what is due, and check that every module is well.

        Raises DriverError for a module that is silent, has rebooted, or is not the one of the robot file.
        """
        back = self._receive(now_s)
        if self._started:
            if back or now_s - self._commanded_s > self._timeouts.command_s:
                self._send(now_s, {})
            if back or now_s - self._asked_s >= RETRY_S:
                self._ask(now_s)
            if now_s - self._heartbeat_s >= self._timeouts.heartbeat_s - TOLERANCE_S:
                self._beat(now_s)
            self._check(now_s)
        reports = {wheel: link.report for wheel, link in self._links.items()}
        return WheelReport({wheel: report for wheel, report in reports.items() if report is not None})

    def command(self, now_s: float, setpoints: Mapping[Wheel, WheelSetpoint]) -> None:
        """Send a set-point to each module; zero while not `ready` and to a wheel that is not mentioned.

        Raises DriverError when a number is not finite (zero has then been sent) or the bus refuses a frame.
        """
        self._commanded_s = now_s
        numbers = [number for point in setpoints.values() for number in (point.speed_mps, point.steering_rad)]
        finite = all(map(math.isfinite, numbers))
        self._send(now_s, setpoints if finite and self.ready else {})
        if not finite:
            raise DriverError("a wheel command is not a finite number; zero was sent instead")

    def stop(self, now_s: float) -> None:
        """Command zero speed at the present steering angles; never raises."""
        with suppress(DriverError):
            self._send(now_s, {})

    def emergency_stop(self, now_s: float) -> None:
        """Zero, then the controllers' own emergency stop. Not a safety function: the contactor is."""
        self._send(now_s, {})
        self._set(now_s, RoboteqObject.EMERGENCY_STOP)

    def release_emergency_stop(self, now_s: float) -> None:
        """Zero, then let the controllers run again; only ever on the explicit act of a person."""
        self._send(now_s, {})
        self._set(now_s, RoboteqObject.EMERGENCY_STOP_RELEASE)

    def close(self) -> None:
        self._line.close()

    def _receive(self, now_s: float) -> bool:
        """Drain the bus; whether a module came back from silence or from a reboot."""
        back = False
        for telegram in self._line.received():
            link = self._by_node.get(telegram.node)
            if link:
                link.take(telegram, now_s)
                back |= link.rebooted or (link.silent and link.heard_s == now_s)
        if back:
            self._starting_s = now_s
        return back

    def _check(self, now_s: float) -> None:
        limit_s = self._timeouts.module_s
        for link in self._links.values():
            link.silent = now_s - link.heard_s > limit_s
            if link.silent:
                link.forget()
        for link in self._links.values():
            if link.silent:
                silence_s = now_s - link.heard_s
                raise DriverError(f"{link.name} has been silent for {silence_s:.2f} s, limit {limit_s:.2f} s")
            if link.rebooted:
                link.rebooted = False
                raise DriverError(f"{link.name} has left operation or rebooted")
            if link.objection is not None:
                raise DriverError(link.objection)
            if link.missing is None:
                continue
            if now_s - self._starting_s > START_LIMIT_S:
                raise DriverError(
                    f"{link.name} has not told {link.missing.value} within {START_LIMIT_S:.0f} s"
                )

    def _ask(self, now_s: float) -> None:
        """Ask every module for what it still has to say."""
        self._asked_s = now_s
        for link in self._links.values():
            if link.missing is Missing.STATE:
                self._line.start_node(now_s, link.module)
            if link.fault_flags is None:
                self._line.read_object(now_s, link.module, RoboteqObject.FAULT_FLAGS)

    def _beat(self, now_s: float) -> None:
        self._heartbeat_s = now_s
        self._line.beat(now_s)

    def _set(self, now_s: float, entry: RoboteqObject) -> None:
        for link in self._links.values():
            self._line.set_object(now_s, link.module, entry)

    def _send(self, now_s: float, setpoints: Mapping[Wheel, WheelSetpoint]) -> None:
        """A set-point for each module; zero at its present angle for a wheel that is not mentioned."""
        self._line.begin_command()
        for wheel, link in self._links.items():
            point = setpoints.get(wheel)
            self._line.drive(now_s, link.module, point.speed_mps if point else 0.0)
            steering_rad = point.steering_rad if point else link.steering_rad
            if steering_rad is not None:  # a wheel whose angle is not known is left where it is
                self._line.steer(now_s, link.module, steering_rad)
