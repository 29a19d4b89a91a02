"""Opening the CAN bus, and writing every frame that passes to can.log."""

from itertools import count
from pathlib import Path

import can
from can.interfaces.virtual import VirtualBus

from fieldnav.errors import DriverError
from fieldnav.settings.robot import Bus

VIRTUAL = "virtual"
FLUSH_S = 1.0
"""At most this much of the log, by its own stamps, is lost when the power fails; our choice."""

_channels = count(1)


def open_bus(settings: Bus) -> can.BusABC:
    """The bus of a robot file. Raises DriverError with the interface and the channel."""
    if settings.interface == VIRTUAL:
        return VirtualBus(settings.channel, preserve_timestamps=True)
    try:
        return can.Bus(
            interface=settings.interface,
            channel=settings.channel,
            bitrate=settings.bitrate,
            ignore_config=True,
        )
    except (can.CanError, OSError, ValueError, ImportError, NotImplementedError) as error:
        raise DriverError(
            f"CAN bus cannot be opened: interface {settings.interface}, channel {settings.channel}: {error}"
        ) from error


def open_virtual_pair() -> tuple[can.BusABC, can.BusABC]:
    """Both ends of a bus of its own within this process: the host's and the simulated modules'."""
    settings = Bus(interface=VIRTUAL, channel=f"fieldnav-{next(_channels)}")
    return open_bus(settings), open_bus(settings)


class LoggedBus(can.BusABC):
    """A bus that writes each frame it sends or receives, once and in order, by the frames' own stamps.

    The log is candump's format, which python-can, can-utils, SavvyCAN and cantools read: T was sent by the
    host, R was received. `channel` is the name it gives the bus. Closes the bus below and the file.
    """

    def __init__(self, bus: can.BusABC, path: Path, channel: str) -> None:
        super().__init__(channel=channel)
        self.channel_info = f"{bus.channel_info}, logged"
        self._bus = bus
        self._channel = channel
        self._log = can.CanutilsLogWriter(path, channel=channel)
        self._flushed_s: float | None = None

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Send, then note; a frame that the bus refuses is not in the log."""
        self._bus.send(msg, timeout)
        msg.is_rx = False
        self._note(msg)

    def recv(self, timeout: float | None = None) -> can.Message | None:
        msg = self._bus.recv(timeout)
        if msg is not None:
            self._note(msg)
        return msg

    def shutdown(self) -> None:
        """Close the bus below and the log; may be repeated."""
        super().shutdown()
        self._bus.shutdown()
        self._log.stop()

    def _note(self, msg: can.Message) -> None:
        msg.channel = self._channel
        self._log.on_message_received(msg)
        if self._flushed_s is None or not 0 <= msg.timestamp - self._flushed_s < FLUSH_S:
            self._log.file.flush()
            self._flushed_s = msg.timestamp
