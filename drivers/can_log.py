"""Opening the CAN bus, and writing every frame that passes to can.log."""

import logging
import socket
from collections.abc import Callable
from itertools import count
from pathlib import Path

import can
from can.interfaces.virtual import VirtualBus

from drivers.can_log_line import LogWriter, shown_channel
from drivers.own_frames import OwnFrames
from drivers.reopened_bus import said
from fieldnav.errors import DriverError, OutputError
from fieldnav.journal.files import private
from fieldnav.settings.robot import Bus

VIRTUAL, SOCKETCAND = "virtual", "socketcand"
SERVER_S = 2.0
"""A server on the robot's own network answers within this. Our choice."""
FLUSH_S = 1.0
"""At most this much of the log, by its own stamps, is lost when the power fails; our choice."""

_channels = count(1)


def open_bus(settings: Bus) -> can.BusABC:
    """The bus of a robot file. Raises DriverError with the interface and the channel."""
    if settings.interface == VIRTUAL:
        return VirtualBus(settings.channel, preserve_timestamps=True)
    logging.getLogger("can").setLevel(logging.CRITICAL)  # what matters comes as an error
    try:
        _reach_server(settings)
        return can.Bus(
            interface=settings.interface,
            channel=settings.channel,
            bitrate=settings.bitrate,
            ignore_config=True,
            **settings.options,  # type: ignore[arg-type]  # of the interface, which knows their kinds
        )
    except (can.CanError, OSError, ValueError, TypeError, ImportError, NotImplementedError) as error:
        bus = f"interface {settings.interface}, channel {settings.channel}"
        raise DriverError(f"CAN bus cannot be opened: {bus}: {said(error)}") from error


def _reach_server(settings: Bus) -> None:
    """Raise OSError where no socketcand answers: python-can would wait for it without end."""
    host, port = settings.options.get("host"), settings.options.get("port")
    if settings.interface == SOCKETCAND and isinstance(host, str) and isinstance(port, int):
        with socket.create_connection((host, port), SERVER_S) as server:
            if not server.recv(1):
                raise ConnectionError("the server closed the connection")


def open_virtual_pair() -> tuple[can.BusABC, can.BusABC]:
    """Both ends of a bus of its own within this process: the host's and the simulated modules'."""
    settings = Bus(interface=VIRTUAL, channel=f"fieldnav-{next(_channels)}")
    return open_bus(settings), open_bus(settings)


class LoggedBus(can.BusABC):
    """A bus that writes each frame it sends or receives, once and in the order in which they pass.

    T was sent by the host, R was received. `channel` is the name that the log gives the bus. With a `clock`,
    the one of the host's own stamps, a line has the moment at which its frame passed, also of one that was
    made earlier in the round; without one, as in simulated time, it has the frame's own stamp. Closes the bus
    below and the file.

    The log never decides whether a frame passes: once it cannot be written it is given up, `failure` says
    why, and the bus goes on. Raises OutputError, with the bus below closed, when it cannot even be begun.
    """

    def __init__(
        self,
        bus: can.BusABC,
        path: Path,
        channel: str,
        append: bool = False,
        clock: Callable[[], float] | None = None,
    ) -> None:
        super().__init__(channel=channel)
        self.channel_info = f"{bus.channel_info}, logged"
        self.failure: str | None = None
        self._bus, self._own = bus, OwnFrames()
        self._name = path.name
        self._flushed_s: float | None = None
        self._clock = clock
        self._log: LogWriter | None = None
        try:
            file = open(path, "a" if append else "w", encoding="ascii", opener=private)  # noqa: SIM115
            self._log = LogWriter(file, channel=shown_channel(channel), append=append)
        except OSError as error:
            self.shutdown()
            raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from error

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Send, then note; a frame that the bus refuses is not in the log."""
        self._own.send(self._bus, msg, timeout)
        msg.is_rx = False
        self._keep(msg, msg.timestamp if self._clock is None else self._clock())

    def recv(self, timeout: float | None = None) -> can.Message | None:
        """The next frame of another; the host's own, where an adapter gives them back, are noted already."""
        msg = self._own.next_of_others(self._bus, timeout)
        if msg is not None:
            msg.is_rx = True  # SocketCAN has it false for what another program of this computer has sent
            if self._clock is not None:
                msg.timestamp = self._clock()
            self._keep(msg, msg.timestamp)
        return msg

    @property
    def state(self) -> can.BusState:
        """What the bus below tells of its controller."""
        return self._bus.state

    @state.setter
    def state(self, new: can.BusState) -> None:
        self._bus.state = new

    def shutdown(self) -> None:
        """Close the bus below and the log; may be repeated."""
        super().shutdown()
        try:
            self._bus.shutdown()
        finally:
            self._close_log()

    def _keep(self, msg: can.Message, stamp_s: float) -> None:
        """Note a frame; if that fails, give the log up for good."""
        if self._log is None:
            return
        try:
            self._log.write(msg, stamp_s)
            if self._flushed_s is None or not 0 <= stamp_s - self._flushed_s < FLUSH_S:
                self._log.file.flush()
                self._flushed_s = stamp_s
        except OSError as error:
            self._give_up(error)
            self._close_log()

    def _close_log(self) -> None:
        """Close the file; it counts as closed also when its last lines find no room."""
        log, self._log = self._log, None
        if log is None:
            return
        try:
            log.stop()
        except OSError as error:
            self._give_up(error)

    def _give_up(self, error: OSError) -> None:
        if self.failure is None:  # what follows the first failure says nothing new
            self.failure = f"{self._name} cannot be written: {error.strerror or error}"
