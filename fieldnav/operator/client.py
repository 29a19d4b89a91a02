"""One caller at the desk: gives one line, gets one line, and is gone."""

import socket
from contextlib import suppress

from fieldnav.errors import FieldnavError
from fieldnav.operator.peer import Peer
from fieldnav.operator.request import Answer, Request
from fieldnav.operator.wire import END, LONGEST_REQUEST_BYTES, answer_line, read_request

PATIENCE_S = 2.0
"""A caller may take so long to give its line, and then the mission to answer it. Our choice."""


class Client:
    """A connection that never blocks and never raises; whatever goes wrong on it ends it."""

    def __init__(self, connection: socket.socket, now_s: float) -> None:
        connection.setblocking(False)
        self._connection, self._since_s = connection, now_s
        self._received = b""
        self._asked = False
        self.gone = False

    def take(self, now_s: float, peer: Peer) -> Request | None:
        """The request, in the round in which its line is whole."""
        if not self._asked:
            self._receive()
        line, end, rest = self._received.partition(END)
        if len(line) > LONGEST_REQUEST_BYTES:
            self.refuse(f"line too long; allowed are {LONGEST_REQUEST_BYTES} bytes")
        elif end and not self._asked:
            return self._understand(line, rest, now_s, peer)
        elif now_s - self._since_s > PATIENCE_S:
            late = "the mission gave no answer" if self._asked else "no whole line came"
            self.refuse(f"{late} within {PATIENCE_S:.0f} s")
        return None

    def refuse(self, said: str) -> None:
        """Say why there is nothing to be had, and hang up."""
        self.answer(Answer(False, said))

    def answer(self, answer: Answer) -> None:
        """Give the answer as far as the connection takes it at once, and hang up; the first one counts."""
        with suppress(OSError):  # nobody there any more, or hung up on already
            self._connection.send(answer_line(answer), socket.MSG_NOSIGNAL)
        self.hang_up()

    def hang_up(self) -> None:
        """End it; may be repeated."""
        self.gone = True
        self._connection.close()

    def _receive(self) -> None:
        """Take in what has come, at most a byte more than is allowed; the end of it ends the caller."""
        try:
            chunk = self._connection.recv(LONGEST_REQUEST_BYTES + len(END) + 1 - len(self._received))
        except BlockingIOError:
            return
        except OSError:
            chunk = b""
        self._received += chunk
        if not chunk:
            self.hang_up()

    def _understand(self, line: bytes, rest: bytes, now_s: float, peer: Peer) -> Request | None:
        try:
            if rest:
                raise FieldnavError("more than one line; allowed is one a connection")
            command = read_request(line)
        except FieldnavError as error:
            self.refuse(str(error))
            return None
        self._asked, self._since_s = True, now_s
        return Request(command, f"process {peer.process}", self.answer)
