"""A bus that can be opened again once it was lost: its adapter was pulled, or its server restarted."""

from collections.abc import Callable
from contextlib import suppress

import can

BUS_ERRORS = (can.CanError, OSError)
"""What a bus raises that is gone or full: python-can's own errors, and those that backends let through."""


def said(error: Exception) -> str:
    """What a backend's error says, in one line; python-can's socketcand has a traceback in its text."""
    text, _, _ = str(error).partition("Traceback (")
    return " ".join(text.split()) or type(error).__name__


class ClosedBus(can.BusABC):
    """In place of one that is closed, each backend of which fails in another way."""

    def __init__(self) -> None:
        super().__init__(channel="closed")

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        raise can.CanOperationError("the bus is closed")

    def recv(self, timeout: float | None = None) -> can.Message | None:
        raise can.CanOperationError("the bus is closed")


class ReopenedBus(can.BusABC):
    """The bus that `opener` opens. Nothing is opened again unasked: what it raises once it may go on raising.

    The constructor raises what `opener` raises.
    """

    def __init__(self, opener: Callable[[], can.BusABC]) -> None:
        self._opener, self._lost = opener, False
        self._bus: can.BusABC = opener()
        super().__init__(channel=self._bus.channel_info)
        self.channel_info = self._bus.channel_info

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        try:
            self._bus.send(msg, timeout)
        except BUS_ERRORS:
            self._lost = True
            raise

    def recv(self, timeout: float | None = None) -> can.Message | None:
        try:
            return self._bus.recv(timeout)
        except BUS_ERRORS:
            self._lost = True
            raise

    def reopen(self) -> None:
        """Open it again if it has failed since it was opened; raises what the opener raises."""
        if not self._lost:
            return
        with suppress(*BUS_ERRORS):
            self._bus.shutdown()  # many an adapter is opened only once at a time
        self._bus = ClosedBus()
        self._bus = self._opener()
        self._lost = False

    @property
    def state(self) -> can.BusState:
        """What the bus below tells of its controller."""
        return self._bus.state

    @state.setter
    def state(self, new: can.BusState) -> None:
        self._bus.state = new

    def shutdown(self) -> None:
        super().shutdown()
        with suppress(*BUS_ERRORS):
            self._bus.shutdown()
