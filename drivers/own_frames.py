"""The host's own frames, which some adapters give back once they are on the bus."""

from collections import deque

import can

REMEMBERED = 256
"""Frames that may still come back: half a second of the host's own traffic. Our choice."""


class OwnFrames:
    """Knows what this host sent lately, so that it is not taken for another's when it comes back.

    python-can marks what comes back by `is_rx` False. On some interfaces, SocketCAN above all, that mark only
    says that the frame was made on this computer: another program's commands have it too, and a simulated
    module's reports. So a frame counts as own only if this host sent the very same, once for each time.
    """

    def __init__(self) -> None:
        self._sent: deque[tuple[int, bool, bytes]] = deque(maxlen=REMEMBERED)

    def send(self, bus: can.BusABC, frame: can.Message, timeout: float | None = None) -> None:
        """Send and remember. The frame is left as it was: python-can's gs_usb pads its data in place."""
        content = _content(frame)
        try:
            bus.send(frame, timeout)
        finally:
            frame.data = bytearray(content[2])
        self._sent.append(content)

    def next_of_others(self, bus: can.BusABC, timeout: float | None) -> can.Message | None:
        """The next frame on the bus that somebody else sent, or an error frame; None after the timeout."""
        while (frame := bus.recv(timeout)) is not None:
            if not self._gave_back(frame):
                return frame
        return None

    def _gave_back(self, frame: can.Message) -> bool:
        if frame.is_rx or frame.is_error_frame or _content(frame) not in self._sent:
            return False
        self._sent.remove(_content(frame))
        return True


def _content(frame: can.Message) -> tuple[int, bool, bytes]:
    return frame.arbitration_id, frame.is_extended_id, bytes(frame.data)
