"""One client of the served bus: its handshake, what it sends, and what waits for it."""

import select
import socket
from collections import deque
from enum import Enum

import can

from fieldnav.simulation.served.can_text import HELLO, OK, RefusedTextError, error_text, read_send, split

MOST_WAITING = 1024
"""Frames kept for a client that does not read, 3 s of the modules' talk; then the oldest are dropped."""
SEND_BUFFER_BYTES = 1 << 15
"""Of the socket: with the default a client that has slept would read minutes of old frames first."""
QUIET_S = 0.2
"""Frames are kept back after the handshake: one that comes with its last answer makes that a wrong answer."""
READ_BYTES = 1024
"""Taken from a client in one step of 5 ms: 25 frames, which is all that a bus of 500 kbit/s carries."""
QUICK_ACKNOWLEDGEMENT: int | None = getattr(socket, "TCP_QUICKACK", None)
"""Where the system has it: else a client's second frame waits 40 ms for the first to be acknowledged."""


class Stage(Enum):
    """How far the handshake is."""

    GREETED = "greeted"
    OPENED = "opened"
    RAW = "raw mode"


class CanClient:
    """A connection; never blocks. Every method raises OSError once the client has gone."""

    def __init__(self, connection: socket.socket, channel: str) -> None:
        connection.setblocking(False)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)
        self._connection = connection
        opening = f"open {channel}"
        self._handshake = {Stage.GREETED: (opening, Stage.OPENED), Stage.OPENED: ("rawmode", Stage.RAW)}
        self._stage = Stage.GREETED
        self._quiet_until_s = 0.0
        self._received = b""
        self._going_out = HELLO
        self._waiting: deque[bytes] = deque(maxlen=MOST_WAITING)
        self._allowance = 0

    def fileno(self) -> int:
        return self._connection.fileno()

    def interest(self, now_s: float) -> int:
        """What to wait for, as flags of select.poll."""
        reading = select.POLLIN if self._allowance > 0 else 0
        return reading | (select.POLLOUT if self._has_words(now_s) else 0)

    def begin_step(self) -> None:
        """Another step's worth of frames may be taken from it."""
        self._allowance = READ_BYTES

    def receive(self, now_s: float) -> list[can.Message]:
        """The frames it has sent. Raises RefusedTextError for anything else than the protocol."""
        arrived = self._connection.recv(READ_BYTES)
        if not arrived:
            raise ConnectionResetError("the client has left")
        if QUICK_ACKNOWLEDGEMENT is not None:
            self._connection.setsockopt(socket.IPPROTO_TCP, QUICK_ACKNOWLEDGEMENT, 1)
        self._allowance -= len(arrived)
        messages, self._received = split(self._received + arrived)
        frames = [self._take(message, now_s) for message in messages]
        return [frame for frame in frames if frame is not None]

    def give(self, text: bytes) -> None:
        """Keep a frame for it, if it is on the bus; a full queue lets its oldest go."""
        if self._stage is Stage.RAW:
            self._waiting.append(text)

    def flush(self, now_s: float) -> None:
        """Send what it takes without waiting."""
        while self._has_words(now_s):
            if not self._going_out:
                self._going_out = b"".join(self._waiting)
                self._waiting.clear()
            try:
                sent = self._connection.send(self._going_out)
            except BlockingIOError:
                return
            self._going_out = self._going_out[sent:]

    def refuse(self, reason: str) -> None:
        """Tell why it is left, if it listens."""
        self._connection.send(error_text(reason))

    def close(self) -> None:
        self._connection.close()

    def _has_words(self, now_s: float) -> bool:
        return bool(self._going_out) or (bool(self._waiting) and now_s >= self._quiet_until_s)

    def _take(self, message: str, now_s: float) -> can.Message | None:
        if self._stage is Stage.RAW:
            self._quiet_until_s = now_s  # who sends has read the last answer
            return read_send(message, now_s)
        expected, then = self._handshake[self._stage]
        if message != expected:
            raise RefusedTextError(f"expected {expected}")
        self._stage = then
        self._going_out += OK
        if then is Stage.RAW:
            self._quiet_until_s = now_s + QUIET_S
        return None
