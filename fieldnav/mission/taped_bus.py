"""The host's end of the bus as the tape hears it."""

import can

from fieldnav.mission.tape import Tape


class TapedBus(can.BusABC):
    """A bus of which every frame is taped, and every time that it fails instead. Closes the bus below."""

    def __init__(self, bus: can.BusABC, tape: Tape) -> None:
        super().__init__(channel="taped")
        self.channel_info = f"{bus.channel_info}, taped"
        self._bus, self._tape = bus, tape

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Raises what the bus below raises."""
        try:
            self._bus.send(msg, timeout)
        except Exception as error:
            self._tape.refused(error, sent=True)
            raise
        self._tape.wire(msg, sent=True)

    def recv(self, timeout: float | None = None) -> can.Message | None:
        """Raises what the bus below raises."""
        try:
            frame = self._bus.recv(timeout)
        except Exception as error:
            self._tape.refused(error, sent=False)
            raise
        if frame is not None:
            self._tape.wire(frame, sent=False)
        return frame

    def shutdown(self) -> None:
        super().shutdown()
        self._bus.shutdown()
