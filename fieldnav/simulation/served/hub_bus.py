"""The end of the served bus inside this process, as python-can has buses."""

import can

from fieldnav.simulation.served.can_hub import CanHub


class HubBus(can.BusABC):
    """What the simulated modules hang on. A frame's stamp is when it reached the hub, in the world's time."""

    def __init__(self, hub: CanHub) -> None:
        super().__init__(channel=hub.channel)
        self.channel_info = "the served bus"
        self._hub = hub

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Never waits: a client that does not read loses its oldest frames."""
        self._hub.pass_on(msg)

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        """What has arrived; it never waits, since the thread that would be waiting is the hub's own."""
        return (self._hub.arrived.popleft() if self._hub.arrived else None), False
