"""Streams over the network, from a motion JPEG server: low latency, opened again, quiet about passwords."""

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Event, Thread

import cv2
import numpy as np
import pytest

from drivers.opencv_camera import open_camera
from drivers.ports import Camera
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame
from fieldnav.settings.camera import CameraSettings
from fieldnav.settings.loading import load_robot

WIDTH_PX, HEIGHT_PX, BRIGHTEST = 64, 48, 200
FRAME_S, PATIENCE_S = 0.02, 20.0
CUT_BYTES, END = 10, b"\xff\xd9"
"""Lost at the end of a damaged frame, of what two dozen bytes hold the pixels; and how each JPEG ends."""
HEAD = b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %d\r\n\r\n%s\r\n"


class Server(ThreadingHTTPServer):
    """Serves plain greys that grow brighter, one level a frame; `level` is the newest one's."""

    def __init__(self, port: int = 0) -> None:
        super().__init__(("127.0.0.1", port), Streaming)
        self.level, self.stopping, self.hanging, self.damaging = 0, Event(), Event(), Event()
        self.size_px = WIDTH_PX, HEIGHT_PX
        self._thread = Thread(target=self.serve_forever, args=(FRAME_S,))
        self._thread.start()

    def stop(self) -> None:
        self.stopping.set()
        self.shutdown()
        self._thread.join()
        self.server_close()


class Streaming(BaseHTTPRequestHandler):
    server: Server

    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
        self.end_headers()
        try:
            while not self.server.stopping.wait(FRAME_S):
                if not self.server.hanging.is_set():
                    self._send_frame()
        except OSError:
            return  # the camera was closed

    def _send_frame(self) -> None:
        self.server.level = (self.server.level + 1) % BRIGHTEST
        width_px, height_px = self.server.size_px
        image = np.full((height_px, width_px, 3), self.server.level, np.uint8)
        data = cv2.imencode(".jpg", image)[1].tobytes()
        if self.server.damaging.is_set():
            data = data[:-CUT_BYTES] + END
        self.wfile.write(HEAD % (len(data), data))

    def log_message(self, format: str, *args: object) -> None:
        """Keep quiet."""


@pytest.fixture
def server() -> Iterator[Server]:
    made = Server()
    yield made
    made.stop()


def settings(source: str) -> CameraSettings:
    changes = {"source": source, "width_px": WIDTH_PX, "height_px": HEIGHT_PX}
    return load_robot("bonnbot").cameras.front.model_copy(update=changes)


def camera_of(port: int) -> Camera:
    source = f"http://eva:secret@127.0.0.1:{port}/video?pwd=secret"
    return open_camera(CameraName.FRONT, settings(source), time.monotonic)


def until(holds: Callable[[], bool]) -> None:
    patient_s = time.monotonic() + PATIENCE_S
    while not holds():
        assert time.monotonic() < patient_s, "it never came"


def newest(camera: Camera) -> Frame | None:
    """None also while it is gone, or of the wrong size."""
    try:
        return camera.latest(time.monotonic())
    except DriverError:
        return None


def fault_of(camera: Camera) -> FaultKind | None:
    try:
        camera.latest(time.monotonic())
    except DriverError as error:
        return error.fault
    return None


def frame_of(camera: Camera, sequence: int) -> Frame:
    """The newest frame, once that many have come."""
    patient_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < patient_s:
        frame = newest(camera)
        if frame is not None and frame.sequence >= sequence:
            return frame
    raise AssertionError(f"frame {sequence} never came")


def error_of(camera: Camera) -> DriverError:
    """What the camera says once its source is gone."""
    until(lambda: newest(camera) is None)
    with pytest.raises(DriverError) as caught:
        camera.latest(time.monotonic())
    return caught.value


def test_a_stream_that_is_of_the_right_size_again_is_seen_to_be(server: Server) -> None:
    server.size_px = WIDTH_PX // 2, HEIGHT_PX // 2
    camera = camera_of(server.server_port)
    until(lambda: fault_of(camera) is FaultKind.CAMERA_SIZE)

    server.size_px = WIDTH_PX, HEIGHT_PX

    until(lambda: newest(camera) is not None)
    camera.close()


def test_a_stream_shows_its_newest_frame_as_old_as_it_is(server: Server) -> None:
    camera = camera_of(server.server_port)
    behind, ages_s = [], []

    for sequence in range(5, 30):
        frame, now_s = frame_of(camera, sequence), time.monotonic()
        behind.append(server.level - int(frame.image[0, 0, 0]))
        ages_s.append(now_s - frame.stamp_s)
    camera.close()

    assert np.median(behind) <= 1
    latency_s = load_robot("bonnbot").cameras.front.latency_s
    assert latency_s <= np.median(ages_s) < latency_s + 2 * FRAME_S


def test_a_stream_that_ends_is_a_fault_until_its_server_is_back_on_the_same_port() -> None:
    server = Server()
    camera = camera_of(server.server_port)
    until(lambda: newest(camera) is not None)
    before = newest(camera)
    assert before is not None

    server.stop()
    error = error_of(camera)
    server = Server(server.server_port)
    until(lambda: newest(camera) is not None)
    after = newest(camera)
    camera.close()
    server.stop()

    assert error.fault is FaultKind.CAMERA_UNPLUGGED
    assert f"front camera: http://***@127.0.0.1:{server.server_port}/video?***: gives no more" in str(error)
    assert after is not None and after.sequence > before.sequence


def test_a_stream_that_hangs_is_given_up_and_opened_again(server: Server) -> None:
    camera = camera_of(server.server_port)
    until(lambda: newest(camera) is not None)

    server.hanging.set()
    error = error_of(camera)
    server.hanging.clear()
    until(lambda: newest(camera) is not None)
    camera.close()

    assert error.fault is FaultKind.CAMERA_UNPLUGGED


def test_a_damaged_frame_of_a_stream_is_none_and_is_told_of_until_a_whole_one_comes(
    server: Server, capfd: pytest.CaptureFixture[str]
) -> None:
    camera = camera_of(server.server_port)
    until(lambda: newest(camera) is not None)

    server.damaging.set()
    error = error_of(camera)
    server.damaging.clear()
    until(lambda: newest(camera) is not None)
    camera.close()

    assert error.fault is FaultKind.CAMERA_UNPLUGGED
    assert str(error).endswith("a frame is no whole picture: its data is damaged")
    assert capfd.readouterr().err == ""


def test_a_video_keeps_all_its_frames_after_a_stream_was_opened(server: Server, tmp_path: Path) -> None:
    path = tmp_path / "drive.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (WIDTH_PX, HEIGHT_PX))
    for level in (100, 200):
        writer.write(np.full((HEIGHT_PX, WIDTH_PX, 3), level, np.uint8))
    writer.release()
    camera_of(server.server_port).close()

    recorded = open_camera(CameraName.REAR, settings(str(path)), time.monotonic)
    frame = recorded.latest(0.0)
    recorded.close()

    assert frame is not None and frame.image.mean() == pytest.approx(100, abs=3)


def test_options_for_ffmpeg_that_the_user_has_set_are_left(
    server: Server, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OPENCV_FFMPEG_CAPTURE_OPTIONS", "rtsp_transport;udp")

    camera_of(server.server_port).close()

    assert os.environ["OPENCV_FFMPEG_CAPTURE_OPTIONS"] == "rtsp_transport;udp"


@pytest.mark.parametrize("scheme", ["rtsp", "http"])
def test_neither_opencv_nor_ffmpeg_says_anything_of_a_stream_that_is_not_there(scheme: str) -> None:
    program = (
        "import sys\n"
        "from drivers.opencv_camera import open_camera\n"
        "from fieldnav.errors import DriverError\n"
        "from fieldnav.messages import CameraName\n"
        "from fieldnav.settings.loading import load_robot\n"
        "settings = load_robot('bonnbot').cameras.front.model_copy(update={'source': sys.argv[1]})\n"
        "try:\n"
        "    open_camera(CameraName.FRONT, settings, lambda: 0.0)\n"
        "except DriverError as error:\n"
        "    print(error)\n"
    )
    command = [sys.executable, "-c", program, f"{scheme}://eva:secret@127.0.0.1:1/video"]

    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=PATIENCE_S)

    said = f"front camera: {scheme}://***@127.0.0.1:1/video: cannot be opened as a camera or a video\n"
    assert (done.stdout, done.stderr) == (said, "")
