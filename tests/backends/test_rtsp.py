"""Cameras that speak RTSP, from a real server: size, order, age, cuts, passwords, and pictures held up."""

import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from socket import SHUT_RDWR, create_connection, create_server, socket
from threading import Event, Thread

import numpy as np
import pytest

from drivers.opencv_camera import open_camera
from drivers.ports import Camera
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame
from fieldnav.settings.loading import load_robot

SYSTEM_PYTHON = "/usr/bin/python3"
SERVER = Path(__file__).with_name("rtsp_server.py")
PACKAGES = "python3-gi gir1.2-gst-rtsp-server-1.0 gstreamer1.0-plugins-good gstreamer1.0-plugins-ugly"
PROBE = """
import gi
gi.require_version("Gst", "1.0")
gi.require_version("GstRtspServer", "1.0")
from gi.repository import Gst, GstRtspServer
Gst.init(None)
assert all(map(Gst.ElementFactory.find, ("x264enc", "rtph264pay", "jpegenc", "rtpjpegpay")))
"""
WIDTH_PX, HEIGHT_PX, RATE_HZ = 1280, 720, 15
CODECS = ("h264", "jpeg")
BITS, MIDDLE_GREY = 32, 125
PATIENCE_S = 60.0
POLL_S = 0.002
FRAMES = 60
HELD_S = 1.4
"""Less than the 2 s after which a stream that gives nothing is given up."""
MAX_LATENCY_S = 0.5
"""What `latency_s` of a robot file can say at most."""
MAX_STAMP_ERROR_S = 0.3
"""Of a machine that others share, which holds up the server too; alone it is some 0.02 s."""


class Server:
    """A stream at PORT's /front; `end` cuts it."""

    def __init__(self, codec: str = "h264", port: int = 0, credentials: tuple[str, ...] = ()) -> None:
        self.port = port or free_port()
        shape = map(str, (WIDTH_PX, HEIGHT_PX, RATE_HZ))
        self._process = subprocess.Popen(
            [SYSTEM_PYTHON, str(SERVER), str(self.port), *shape, codec, *credentials],
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self._process.stdout is not None
        assert self._process.stdout.readline() == "ready\n"

    def end(self) -> None:
        """May be repeated."""
        self._process.kill()
        self._process.wait()
        self._process.stdout.close()


class Network:
    """Passes on what goes between a camera's client and its server, and can hold up what the camera says."""

    def __init__(self, server_port: int) -> None:
        self._server_port = server_port
        self._listening = create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        self.flowing = Event()
        self.flowing.set()
        Thread(target=self._accept, daemon=True).start()

    def close(self) -> None:
        self.flowing.set()
        self._listening.close()

    def _accept(self) -> None:
        while True:
            try:
                client, _ = self._listening.accept()
            except OSError:
                return  # closed
            server = create_connection(("127.0.0.1", self._server_port))
            for ends in ((client, server, False), (server, client, True)):
                Thread(target=self._pass_on, args=ends, daemon=True).start()

    def _pass_on(self, source: socket, sink: socket, held: bool) -> None:
        try:
            while data := source.recv(1 << 16):
                if held:
                    self.flowing.wait(PATIENCE_S)
                sink.sendall(data)
            sink.shutdown(SHUT_RDWR)
        except OSError:
            return  # one end is gone


def free_port() -> int:
    with create_server(("127.0.0.1", 0)) as taken:
        return int(taken.getsockname()[1])


def camera_at(port: int, credentials: str = "") -> Camera:
    """The camera of a robot file whose source is that stream."""
    changes = {
        "source": f"rtsp://{credentials}127.0.0.1:{port}/front",
        "width_px": WIDTH_PX,
        "height_px": HEIGHT_PX,
    }
    settings = load_robot("bonnbot").cameras.front.model_copy(update=changes | {"latency_s": 0.0})
    return open_camera(CameraName.FRONT, settings, time.monotonic)


def made_s(frame: Frame) -> float:
    """When the server made a picture, read from its blocks."""
    line, block = frame.image[HEIGHT_PX // 4, :, 0], WIDTH_PX // BITS
    bits = line[block // 2 :: block][:BITS] > MIDDLE_GREY
    return int("".join(map(str, bits.astype(int))), 2) / 1000


def newest(camera: Camera) -> Frame | None:
    """None also while it is gone."""
    try:
        return camera.latest(time.monotonic())
    except DriverError:
        return None


def frames_of(camera: Camera, wanted: Callable[[list[Frame]], bool]) -> list[Frame]:
    """The frames from now on, each as it comes, until they are as wanted."""
    frames: list[Frame] = []
    patient_until_s = time.monotonic() + PATIENCE_S
    while not wanted(frames):
        assert time.monotonic() < patient_until_s, f"it never came: {len(frames)} frames"
        frame = newest(camera)
        if frame is not None and (not frames or frame.sequence > frames[-1].sequence):
            frames.append(frame)
        time.sleep(POLL_S)
    return frames


@pytest.fixture(scope="module", autouse=True)
def _packages() -> None:
    probed = subprocess.run([SYSTEM_PYTHON, "-c", PROBE], capture_output=True, check=False)
    if probed.returncode:
        pytest.skip(f"needs these of Debian's packages: {PACKAGES}")


@pytest.fixture
def serve() -> Iterator[Callable[..., Server]]:
    made: list[Server] = []

    def make(*arguments: object) -> Server:
        made.append(Server(*arguments))
        return made[-1]

    yield make
    for server in made:
        server.end()


@pytest.fixture
def camera_of() -> Iterator[Callable[..., Camera]]:
    opened: list[Camera] = []

    def open_at(port: int, credentials: str = "") -> Camera:
        opened.append(camera_at(port, credentials))
        return opened[-1]

    yield open_at
    for camera in opened:
        camera.close()


@pytest.mark.parametrize("codec", CODECS)
def test_its_frames_come_whole_in_order_and_as_old_as_they_say(
    serve: Callable[..., Server],
    camera_of: Callable[..., Camera],
    codec: str,
) -> None:
    camera = camera_of(serve(codec).port)

    frames = frames_of(camera, lambda frames: len(frames) == FRAMES)

    assert {frame.image.shape for frame in frames} == {(HEIGHT_PX, WIDTH_PX, 3)}
    assert np.diff([made_s(frame) for frame in frames]).min() > 0
    latencies_s = [frame.stamp_s - made_s(frame) for frame in frames[FRAMES // 2 :]]
    least, median, most = np.quantile(latencies_s, [0, 0.5, 1])
    print(f"{codec}: {least:.3f} s from picture to stamp, {median:.3f} s median, {most:.3f} s at most")
    assert most < MAX_LATENCY_S
    assert most - least < MAX_STAMP_ERROR_S


@pytest.mark.parametrize("codec", CODECS)
def test_frames_that_the_network_held_up_are_as_old_as_they_are(
    serve: Callable[..., Server], camera_of: Callable[..., Camera], codec: str
) -> None:
    network = Network(serve(codec).port)
    camera = camera_of(network.port)
    before = frames_of(camera, lambda frames: len(frames) == FRAMES)

    network.flowing.clear()
    time.sleep(HELD_S)
    network.flowing.set()
    after = frames_of(camera, lambda frames: len(frames) == RATE_HZ)
    network.close()

    latency_s = np.median([frame.stamp_s - made_s(frame) for frame in before[FRAMES // 2 :]])
    errors_s = [frame.stamp_s - made_s(frame) - latency_s for frame in after]
    assert np.abs(errors_s).max() < MAX_STAMP_ERROR_S


def test_a_stream_that_is_cut_is_a_fault_until_it_is_back(
    serve: Callable[..., Server], camera_of: Callable[..., Camera]
) -> None:
    server = serve()
    camera = camera_of(server.port)
    (before,) = frames_of(camera, lambda frames: len(frames) == 1)

    server.end()
    frames_of(camera, lambda _: newest(camera) is None)
    with pytest.raises(DriverError) as caught:
        camera.latest(time.monotonic())
    serve("h264", server.port)
    after = frames_of(camera, lambda frames: len(frames) == 1)[0]

    assert caught.value.fault is FaultKind.CAMERA_UNPLUGGED
    assert after.sequence > before.sequence
    assert abs(time.monotonic() - made_s(after)) < PATIENCE_S


def test_a_password_opens_it_and_is_not_told(
    serve: Callable[..., Server], camera_of: Callable[..., Camera]
) -> None:
    server = serve("h264", 0, ("eva", "secret"))

    camera = camera_of(server.port, "eva:secret@")
    frames_of(camera, lambda frames: len(frames) == 1)
    with pytest.raises(DriverError) as caught:
        camera_of(server.port, "eva:wrong@")

    assert "wrong" not in str(caught.value)
    assert f"rtsp://***@127.0.0.1:{server.port}/front: cannot be opened" in str(caught.value)
