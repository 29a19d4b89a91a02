"""The served bus: what one node says is heard by all others, the modules in this process among them."""

import math
import select
import socket
from collections import deque
from collections.abc import Callable
from contextlib import suppress

import can

from fieldnav.errors import SettingsError
from fieldnav.simulation.served import LOOPBACK
from fieldnav.simulation.served.can_client import CanClient
from fieldnav.simulation.served.can_text import RefusedTextError, frame_text

MOST_CLIENTS = 16
MILLISECONDS_PER_SECOND = 1000


class CanHub:
    """A socketcand server on loopback. One thread attends it; nothing else may call it meanwhile.

    `clock` is the world's time and `epoch_s` what it began at, since 1970. Raises SettingsError for a port
    that is not to be had.
    """

    def __init__(self, port: int, channel: str, clock: Callable[[], float], epoch_s: float) -> None:
        self.channel, self._clock, self._epoch_s = channel, clock, epoch_s
        self.arrived: deque[can.Message] = deque()
        self._clients: dict[int, CanClient] = {}
        try:
            self._listener = socket.create_server((LOOPBACK, port))
        except OSError as error:
            raise SettingsError(
                f"--port: {port} cannot be listened at: {error.strerror}; allowed is a free port, or 0"
            ) from error
        self._listener.setblocking(False)

    @property
    def address(self) -> tuple[str, int]:
        host, port = self._listener.getsockname()
        return str(host), int(port)

    @property
    def clients(self) -> int:
        return len(self._clients)

    def attend(self, until_s: float) -> None:
        """Carry frames until that time; once over what waits already when it has passed."""
        for client in self._clients.values():
            client.begin_step()
        while True:
            self._attend_once(max(0.0, until_s - self._clock()))
            if self._clock() >= until_s:
                return

    def pass_on(self, frame: can.Message, sender: CanClient | None = None) -> None:
        """Let all clients but the sender hear a frame."""
        text = frame_text(frame, self._epoch_s + frame.timestamp)
        for client in self._clients.values():
            if client is not sender:
                client.give(text)

    def close(self) -> None:
        self._listener.close()
        for client in self._clients.values():
            client.close()
        self._clients.clear()

    def _attend_once(self, wait_s: float) -> None:
        poll = select.poll()
        poll.register(self._listener, select.POLLIN)
        for number, client in self._clients.items():
            poll.register(number, client.interest(self._clock()))
        for number, happened in poll.poll(math.ceil(wait_s * MILLISECONDS_PER_SECOND)):
            if number == self._listener.fileno():
                self._accept()
            else:
                self._serve(self._clients[number], happened)

    def _accept(self) -> None:
        try:
            connection, _ = self._listener.accept()
        except OSError:  # it has left again, or there is no file number for it
            return
        if len(self._clients) >= MOST_CLIENTS:
            connection.close()
            return
        client = CanClient(connection, self.channel)
        client.begin_step()
        self._clients[client.fileno()] = client

    def _serve(self, client: CanClient, happened: int) -> None:
        """Take what a client sends and give it what waits; one that is gone or speaks wrongly is closed."""
        try:
            if happened & ~select.POLLOUT:
                for frame in client.receive(self._clock()):
                    self.arrived.append(frame)
                    self.pass_on(frame, client)
            client.flush(self._clock())
        except RefusedTextError as error:
            with suppress(OSError):
                client.refuse(str(error))
            self._leave(client)
        except OSError:
            self._leave(client)

    def _leave(self, client: CanClient) -> None:
        del self._clients[client.fileno()]
        client.close()
