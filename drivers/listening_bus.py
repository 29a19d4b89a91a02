"""A bus on which nothing is said: for a dry run, which decides everything and moves nothing."""

import can


class ListeningBus(can.BusABC):
    """Receives from the bus below and lets nothing out. Closes the bus below."""

    def __init__(self, bus: can.BusABC) -> None:
        super().__init__(channel="listening")
        self.channel_info = f"{bus.channel_info}, listening only"
        self._bus = bus

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Say nothing."""

    def recv(self, timeout: float | None = None) -> can.Message | None:
        return self._bus.recv(timeout)

    def shutdown(self) -> None:
        super().shutdown()
        self._bus.shutdown()
