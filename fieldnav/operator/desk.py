"""The mission's end of the operator's line: looked at once a round, and nothing on it holds up the loop."""

import select
import socket
from types import TracebackType
from typing import Self

from fieldnav.operator.client import Client
from fieldnav.operator.doorway import Doorway
from fieldnav.operator.peer import Peer, PeerOf, peer_of
from fieldnav.operator.request import Request
from fieldnav.operator.socket_place import SocketPlace, socket_path

MOST_CLIENTS = 8
"""Callers at a time; the next is told to try again. Our choice."""


class Desk:
    """Takes in callers of the same user, hands on what they ask. No thread, no wait, nothing raised."""

    def __init__(self, doorway: Doorway, user: int, peer_of: PeerOf = peer_of) -> None:
        self._doorway, self._user, self._peer_of = doorway, user, peer_of
        self._bell = select.poll()
        self._bell.register(doorway.listener, select.POLLIN)
        self._clients: list[tuple[Client, Peer]] = []

    @classmethod
    def open(cls, run: str, place: SocketPlace | None = None, peer_of: PeerOf = peer_of) -> Self:
        """The desk of the run whose directory has this name. Raises OutputError."""
        place = place or SocketPlace()
        return cls(Doorway.make(socket_path(place.make(), run)), place.user, peer_of)

    def poll(self, now_s: float) -> tuple[Request, ...]:
        """What has been asked since the last look, each to be answered by its `reply`."""
        self._clients = [(client, peer) for client, peer in self._clients if not client.gone]
        if self._bell.poll(0):
            self._admit(now_s)
        asked = [client.take(now_s, peer) for client, peer in self._clients]
        return tuple(request for request in asked if request is not None)

    def close(self) -> None:
        """Send everybody away and remove the socket's file; may be repeated."""
        for client, _ in self._clients:
            client.refuse("the mission has ended")
        self._clients = []
        self._doorway.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _admit(self, now_s: float) -> None:
        """Take in those who wait at the door, so many a round and no more."""
        for _ in range(MOST_CLIENTS):
            try:
                connection, _ = self._doorway.listener.accept()
            except OSError:  # nobody waits any more, or there is no descriptor left for one
                return
            self._receive(connection, now_s)

    def _receive(self, connection: socket.socket, now_s: float) -> None:
        client = Client(connection, now_s)
        try:
            peer = self._peer_of(connection)
        except OSError:
            client.hang_up()
            return
        if peer.user != self._user:
            client.refuse(f"user {peer.user} may not speak to this mission; allowed is user {self._user}")
        elif len(self._clients) >= MOST_CLIENTS:
            client.refuse(f"{MOST_CLIENTS} others speak to this mission; try again")
        else:
            self._clients.append((client, peer))
