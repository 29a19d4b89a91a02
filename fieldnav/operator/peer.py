"""Who is at the other end of a local socket, as the kernel tells it."""

import socket
import struct
from collections.abc import Callable
from dataclasses import dataclass

CREDENTIALS = struct.Struct("3i")
"""struct ucred of unix(7): process, user, group."""


@dataclass(frozen=True, slots=True)
class Peer:
    """The process that connected and the user it ran for then."""

    process: int
    user: int


PeerOf = Callable[[socket.socket], Peer]


def peer_of(connection: socket.socket) -> Peer:
    """The peer of a connected Unix socket; a peer cannot forge it. Raises OSError."""
    said = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, CREDENTIALS.size)
    process, user, _ = CREDENTIALS.unpack(said)
    return Peer(process, user)
