"""What the host says to all four modules in one go; a frame that fails keeps no other from going out."""

from collections.abc import Callable, Iterable, Mapping
from functools import partial

from drivers.host_line import HostLine
from drivers.module_link import Missing, ModuleLink
from drivers.thorvald_protocol import MODE_VARIABLE, Mode, RoboteqObject
from fieldnav.errors import DriverError
from fieldnav.messages import Wheel, WheelSetpoint

Frame = Callable[[], None]
"""A frame that is still to be sent."""


class ModuleRounds:
    """Rounds to every module; each tries all its frames, then raises DriverError for the first failure."""

    def __init__(self, line: HostLine, links: Mapping[Wheel, ModuleLink]) -> None:
        self._line = line
        self._links = links

    def drive(self, now_s: float, setpoints: Mapping[Wheel, WheelSetpoint]) -> None:
        """A set-point for each module; zero at its present angle for a wheel that is not mentioned.

        A process may be suspended between any two frames: where something is to move, each is looked at.
        """
        moves = any(point.speed_mps for point in setpoints.values())
        self._line.begin_command()
        frames: list[tuple[ModuleLink, Frame]] = []
        for wheel, link in self._links.items():
            point = setpoints.get(wheel)
            speed_mps = point.speed_mps if point else 0.0
            frames.append((link, partial(self._line.drive, now_s, link.module, speed_mps)))
            steering_rad = point.steering_rad if point else link.steering_rad
            if steering_rad is not None:  # a wheel whose angle is not known is left where it is
                frames.append((link, partial(self._line.steer, now_s, link.module, steering_rad)))
        _send_all(frames, partial(self._line.check_decided, now_s) if moves else None)

    def ask(self, now_s: float) -> None:
        """Start every module that is not in operation, and ask each for its fault flags."""
        frames: list[tuple[ModuleLink, Frame]] = []
        for link in self._links.values():
            if link.missing is Missing.STATE:
                frames.append((link, partial(self._line.start_node, now_s, link.module)))
            link.faults.asked()
            entry = RoboteqObject.FAULT_FLAGS
            frames.append((link, partial(self._line.read_object, now_s, link.module, entry)))
        _send_all(frames)

    def ask_mode(self, now_s: float) -> None:
        """Set the mode "drive" where it is not known to be set, and ask every module for its mode."""
        frames: list[tuple[ModuleLink, Frame]] = []
        for link in self._links.values():
            if link.mode.value != Mode.DRIVE:
                frames.append((link, partial(self._line.set_mode, now_s, link.module, Mode.DRIVE)))
            link.mode.asked()
            variable = RoboteqObject.USER_VARIABLE, MODE_VARIABLE
            frames.append((link, partial(self._line.read_object, now_s, link.module, *variable)))
        _send_all(frames)

    def set(self, now_s: float, entry: RoboteqObject) -> None:
        """Write 1 to an object of every module that acts when written."""
        links = self._links.values()
        _send_all([(link, partial(self._line.set_object, now_s, link.module, entry)) for link in links])


def _send_all(frames: Iterable[tuple[ModuleLink, Frame]], check: Callable[[], None] | None = None) -> None:
    first: DriverError | None = None
    for link, send in frames:
        try:
            if check is not None:
                check()
            send()
        except DriverError as error:
            if first is None:
                first = DriverError(f"{link.name}: {error}", error.fault)
                first.__cause__ = error
    if first is not None:
        raise first
