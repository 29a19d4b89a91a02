"""The cameras over HTTP: /front.mjpg and /rear.mjpg as motion JPEG, /front.jpg and /rear.jpg one picture."""

import socket
import sys
from collections.abc import Mapping
from contextlib import suppress
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from typing import Any

from fieldnav.errors import SettingsError
from fieldnav.messages import CameraName
from fieldnav.simulation.served import LOOPBACK
from fieldnav.simulation.served.picture_feed import Picture, PictureFeed

STREAM, STILL = "mjpg", "jpg"
BOUNDARY = "picture"
SILENT_S = 10.0
"""A watcher that takes nothing for so long is left; its thread would wait for ever."""
SEND_BUFFER_BYTES = 1 << 17
"""Of a watcher's socket, less than one picture: what lies in it is old before it is seen."""
CLOSING_POLL_S = 0.05


class PictureServer:
    """Serves on loopback from a thread of its own, and each watcher from another, until closed.

    Raises SettingsError for a port that is not to be had.
    """

    def __init__(self, port: int, feeds: Mapping[CameraName, PictureFeed]) -> None:
        try:
            self._server = _Server(port, feeds)
        except OSError as error:
            raise SettingsError(
                f"--port: {port}, for pictures, cannot be listened at: {error.strerror}; "
                "allowed is a number that is free and the next one too, or 0"
            ) from error
        self._thread = Thread(target=self._server.serve_forever, args=(CLOSING_POLL_S,), name="pictures")
        self._thread.start()

    @property
    def address(self) -> tuple[str, int]:
        host, port = self._server.socket.getsockname()
        return str(host), int(port)

    def source(self, name: CameraName) -> str:
        """What a robot file calls this camera."""
        host, port = self.address
        return f"http://{host}:{port}/{name.value}.{STREAM}"

    def close(self) -> None:
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()


class _Server(ThreadingHTTPServer):
    def __init__(self, port: int, feeds: Mapping[CameraName, PictureFeed]) -> None:
        self.feeds = {name.value: feed for name, feed in feeds.items()}
        super().__init__((LOOPBACK, port), _Watcher)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A watcher that has left is no error of ours."""
        if not isinstance(sys.exception(), OSError):
            super().handle_error(request, client_address)


class _Watcher(BaseHTTPRequestHandler):
    """One request."""

    server: _Server
    timeout = SILENT_S

    def do_GET(self) -> None:
        name, _, ending = self.path.removeprefix("/").rpartition(".")
        feed = self.server.feeds.get(name)
        if feed is None or ending not in (STREAM, STILL):
            allowed = ", ".join(f"/{each}.{kind}" for each in self.server.feeds for kind in (STREAM, STILL))
            self.send_error(HTTPStatus.NOT_FOUND, explain=f"There are {allowed}.")
            return
        self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)
        with feed.watching(), suppress(OSError):  # it has left, or takes nothing
            self._send_stream(feed) if ending == STREAM else self._send_still(feed)

    def log_message(self, format: str, *arguments: object) -> None:
        """Requests are nobody's news."""

    def _send_still(self, feed: PictureFeed) -> None:
        picture = feed.newer_than(0)
        if picture is None:
            self.send_error(HTTPStatus.SERVICE_UNAVAILABLE)
            return
        self._begin("image/jpeg", length=len(picture.jpeg))
        self.wfile.write(picture.jpeg)

    def _send_stream(self, feed: PictureFeed) -> None:
        """Always the newest picture: what has come meanwhile is left out."""
        self._begin(f"multipart/x-mixed-replace; boundary={BOUNDARY}")
        sequence = 0
        while (picture := feed.newer_than(sequence)) is not None:
            sequence = picture.sequence
            self.wfile.write(_part(picture))

    def _begin(self, content: str, length: int | None = None) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", content)
        self.send_header("Cache-Control", "no-store")
        if length is not None:
            self.send_header("Content-Length", str(length))
        self.end_headers()


def _part(picture: Picture) -> bytes:
    head = (
        f"--{BOUNDARY}\r\nContent-Type: image/jpeg\r\nContent-Length: {len(picture.jpeg)}\r\n"
        f"X-Exposed: {picture.stamp_s:.3f}\r\n\r\n"
    )
    return head.encode() + picture.jpeg + b"\r\n"
