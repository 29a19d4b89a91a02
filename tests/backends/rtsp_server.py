"""A camera that speaks RTSP: /usr/bin/python3 rtsp_server.py PORT WIDTH HEIGHT RATE CODEC [USER PASSWORD].

By GStreamer, for the system's own Python, which Debian's python3-gi and gir1.2-gst-rtsp-server-1.0 belong
to; hence no third package here. Says "ready" when it listens. Each picture carries in its upper part, as
black and white blocks, when it was made: milliseconds of the machine's monotonic clock.
"""

import sys
import time

import gi

gi.require_version("Gst", "1.0")
gi.require_version("GstRtspServer", "1.0")
from gi.repository import GLib, Gst, GstRtspServer  # noqa: E402  # the versions come first

BITS = 32
GREY, BLACK, WHITE = 110, 16, 235
ENCODERS = {
    "h264": "x264enc tune=zerolatency speed-preset=ultrafast key-int-max=15 ! rtph264pay name=pay0 pt=96",
    "jpeg": "jpegenc ! rtpjpegpay name=pay0 pt=26",
}
LAUNCH = (
    "( appsrc name=made is-live=true do-timestamp=true format=time max-buffers=2 leaky-type=downstream "
    "caps=video/x-raw,format=GRAY8,width={width},height={height},framerate={rate}/1 "
    "! videoconvert ! video/x-raw,format=I420 ! {encoder} )"
)
ROLE = "viewer"


class Stream:
    """One stream for all who look; a new picture at every beat of its rate."""

    def __init__(self, width: int, height: int, rate: int, codec: str) -> None:
        self._width, self._height, self._rate = width, height, rate
        self.factory = GstRtspServer.RTSPMediaFactory()
        self.factory.set_launch(LAUNCH.format(width=width, height=height, rate=rate, encoder=ENCODERS[codec]))
        self.factory.set_shared(True)
        self.factory.set_latency(0)
        self.factory.connect("media-configure", self._begin)

    def _begin(self, _factory: GstRtspServer.RTSPMediaFactory, media: GstRtspServer.RTSPMedia) -> None:
        source = media.get_element().get_by_name("made")
        beat = GLib.timeout_add(1000 // self._rate, self._push, source)
        media.connect("unprepared", lambda _media: GLib.source_remove(beat))

    def _push(self, source: Gst.Element) -> bool:
        source.emit("push-buffer", Gst.Buffer.new_wrapped(self._picture(int(time.monotonic() * 1000))))
        return True

    def _picture(self, milliseconds: int) -> bytes:
        block = self._width // BITS
        bits = (milliseconds >> (BITS - 1 - number) & 1 for number in range(BITS))
        line = b"".join(bytes([WHITE if bit else BLACK]) * block for bit in bits)
        line = line.ljust(self._width, bytes([BLACK]))
        upper = self._height // 2
        return line * upper + bytes([GREY]) * (self._width * (self._height - upper))


def ask_for_password(server: GstRtspServer.RTSPServer, stream: Stream, user: str, password: str) -> None:
    """Let nobody look who does not know it."""
    auth, token = GstRtspServer.RTSPAuth(), GstRtspServer.RTSPToken()
    token.set_string("media.factory.role", ROLE)
    auth.add_basic(GstRtspServer.RTSPAuth.make_basic(user, password), token)
    server.set_auth(auth)
    permissions = GstRtspServer.RTSPPermissions()
    for what in ("media.factory.access", "media.factory.construct"):
        permissions.add_permission_for_role(ROLE, what, True)
    stream.factory.set_permissions(permissions)


def serve(port: str, width: str, height: str, rate: str, codec: str, *credentials: str) -> None:
    Gst.init(None)
    server, stream = GstRtspServer.RTSPServer(), Stream(int(width), int(height), int(rate), codec)
    server.set_address("127.0.0.1")
    server.set_service(port)
    if credentials:
        ask_for_password(server, stream, *credentials)
    server.get_mount_points().add_factory("/front", stream.factory)
    server.attach(None)
    print("ready", flush=True)
    GLib.MainLoop().run()


if __name__ == "__main__":
    serve(*sys.argv[1:])
