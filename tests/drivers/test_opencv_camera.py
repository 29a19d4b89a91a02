"""The camera of a robot file: recordings are played at their rate; a source that fails is named."""

import os
import re
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest

from drivers.opencv_camera import open_camera
from drivers.ports import Camera
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame, Image
from fieldnav.settings.camera import CameraSettings
from fieldnav.settings.loading import load_robot
from fieldnav.settings.shown_source import shown

WIDTH_PX, HEIGHT_PX, RATE_HZ = 64, 48, 10.0
COUNT, STEP = 12, 20
"""Frames of a recording, each a plain grey, and the grey levels from one to the next."""


def settings(source: Path | str, width_px: int = WIDTH_PX) -> CameraSettings:
    changes = {"source": str(source), "width_px": width_px, "height_px": HEIGHT_PX, "rate_hz": RATE_HZ}
    return load_robot("bonnbot").cameras.front.model_copy(update=changes)


def grey(level: int) -> Image:
    return np.full((HEIGHT_PX, WIDTH_PX, 3), level, np.uint8)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Pictures by name, and a file that is none."""
    made = tmp_path / "frames"
    made.mkdir()
    for index in range(COUNT):
        cv2.imwrite(str(made / f"{index:03d}.png"), grey(STEP * index))
    (made / "000.txt").write_text("notes")
    return made


@pytest.fixture
def video(tmp_path: Path) -> Path:
    path = tmp_path / "drive.avi"
    size = (WIDTH_PX, HEIGHT_PX)
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), RATE_HZ, size)
    for index in range(COUNT):
        writer.write(grey(STEP * index))
    writer.release()
    return path


@pytest.fixture(params=["folder", "video"])
def recording(request: pytest.FixtureRequest) -> Iterator[Camera]:
    source = request.getfixturevalue(request.param)
    camera = open_camera(CameraName.FRONT, settings(source), clock=lambda: 0.0)
    yield camera
    camera.close()


def index_of(frame: Frame | None) -> int:
    """Which picture of a recording a frame is, by its grey."""
    assert frame is not None
    return round(float(frame.image.mean()) / STEP)


def test_a_recording_is_played_at_its_rate(recording: Camera) -> None:
    shown = [recording.latest(100 + at_s) for at_s in (0.0, 0.05, 0.1, 0.25)]

    assert [index_of(frame) for frame in shown] == [0, 0, 1, 2]
    assert [frame.stamp_s for frame in shown if frame] == pytest.approx([100, 100, 100.1, 100.2])
    assert shown[0] is shown[1], "the same object until a newer frame arrives"
    assert shown[0] and shown[0].camera is CameraName.FRONT


def test_frames_nobody_asked_for_are_passed_over(recording: Camera) -> None:
    recording.latest(0.0)

    late = recording.latest(0.95)

    assert index_of(late) == 9
    assert late and (late.sequence, late.stamp_s) == (10, pytest.approx(0.9))


def test_after_the_end_the_last_frame_grows_old(recording: Camera) -> None:
    frames = [recording.latest(tick / RATE_HZ) for tick in range(COUNT + 30)]

    assert index_of(frames[-1]) == COUNT - 1
    assert frames[-1] is frames[COUNT - 1]


def test_a_still_picture_is_seen_for_ever_and_never_stale(folder: Path) -> None:
    camera = open_camera(CameraName.REAR, settings(folder / "003.png"), clock=lambda: 0.0)

    frames = [camera.latest(at_s) for at_s in (0.0, 5.0, 500.0)]

    assert [index_of(frame) for frame in frames] == [3, 3, 3]
    assert [frame.stamp_s for frame in frames if frame] == [0.0, 5.0, 500.0]


def test_a_recording_of_another_size_is_refused_naming_both(folder: Path) -> None:
    camera = open_camera(CameraName.FRONT, settings(folder, width_px=80), clock=lambda: 0.0)

    with pytest.raises(DriverError, match="frames: gives 64x48 px; the robot file has width_px 80") as caught:
        camera.latest(0.0)

    assert caught.value.fault is FaultKind.CAMERA_SIZE


@pytest.mark.parametrize(
    ("source", "content", "words"),
    [
        ("nowhere", None, "nowhere: there is no such device, video, picture or folder"),
        ("/dev/video-none", None, "/dev/video-none: there is no such device"),
        ("broken.avi", b"no video", "broken.avi: cannot be opened as a camera or a video"),
        ("\udcff.avi", b"RIFF", "the name is no text"),
        ("broken.png", b"no picture", "broken.png: is no whole picture"),
        ("63", None, "63: cannot be opened as a camera"),
        ("", b"", "holds no picture; allowed are .jpg"),
    ],
)
def test_a_source_that_cannot_be_opened_is_named(
    source: str,
    content: bytes | None,
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    if content:
        Path(source).write_bytes(content)
    (tmp_path / "empty").mkdir()

    with pytest.raises(DriverError, match=f"rear camera: .*{words}") as caught:
        open_camera(CameraName.REAR, settings(source or "empty"), clock=lambda: 0.0)

    assert caught.value.fault is FaultKind.CAMERA_UNPLUGGED
    assert capfd.readouterr().err == "", "OpenCV adds no words of its own"


def test_a_pipe_is_no_camera(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")

    with pytest.raises(DriverError, match="is a pipe"):
        open_camera(CameraName.FRONT, settings(tmp_path / "pipe"), lambda: 0.0)


def test_a_pipeline_is_refused_in_one_line_where_opencv_has_no_gstreamer(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(cv2.videoio_registry, "hasBackend", lambda backend: False)
    pipeline = "rtspsrc location=rtsp://eva:secret@camera/1 user-pw=secret ! decodebin ! appsink"

    with pytest.raises(DriverError) as caught:
        open_camera(CameraName.FRONT, settings(pipeline), lambda: 0.0)

    said = "rtspsrc location=rtsp://***@camera/1 user-pw=*** ! decodebin ! appsink"
    assert str(caught.value) == f"front camera: {said}: is a GStreamer pipeline; this OpenCV has no GStreamer"


@pytest.mark.parametrize(
    ("source", "read"),
    [
        ("/dev/video0", "/dev/video0"),
        ("/media/what?@home/drive.mp4", "/media/what?@home/drive.mp4"),
        ("rtsp://camera:554/stream", "rtsp://camera:554/stream"),
        ("rtsp://eva:secret@camera:554/stream", "rtsp://***@camera:554/stream"),
        ("rtsp://eva:sec@re/t@camera/stream", "rtsp://***@camera/stream"),
        ("http://camera/video?user=eva&pwd=secret", "http://camera/video?***"),
        ("https://eva:secret@camera/video?token=secret", "https://***@camera/video?***"),
        ('soup location="http://c/v?pwd=secret" ! appsink', 'soup location="http://c/v?***" ! appsink'),
        ('rtspsrc user-id=eva user-pw="sec ret" ! appsink', "rtspsrc user-id=eva user-pw=*** ! appsink"),
    ],
)
def test_a_source_is_shown_without_its_password(source: str, read: str) -> None:
    assert shown(source) == read


def test_the_pictures_of_a_folder_are_played_by_their_numbers_and_hidden_files_left_out(
    tmp_path: Path,
) -> None:
    for index, number in enumerate([1, 2, 9, 10, 11]):
        cv2.imwrite(str(tmp_path / f"frame{number}.png"), grey(STEP * index))
    (tmp_path / "._frame1.png").write_bytes(b"what a memory card keeps beside each picture")
    camera = open_camera(CameraName.FRONT, settings(tmp_path), clock=lambda: 0.0)

    assert [index_of(camera.latest(at / RATE_HZ)) for at in range(5)] == [0, 1, 2, 3, 4]


@pytest.mark.parametrize("suffix", [".jpg", ".avi"])
def test_a_damaged_frame_of_a_recording_is_none_and_is_named(
    suffix: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    grain = np.random.default_rng(1).integers(0, 256, (3, HEIGHT_PX, WIDTH_PX, 3)).astype(np.uint8)
    if suffix == ".avi":
        source = damaged = tmp_path / "drive.avi"
        writer = cv2.VideoWriter(str(source), cv2.VideoWriter.fourcc(*"MJPG"), RATE_HZ, (WIDTH_PX, HEIGHT_PX))
        for each in grain:
            writer.write(each)
        writer.release()
    else:
        source, damaged = tmp_path, tmp_path / "1.jpg"
        for number, each in enumerate(grain):
            cv2.imwrite(str(tmp_path / f"{number}.jpg"), each)
    content = damaged.read_bytes()
    *_, begin, end = [0, *(each.start() for each in re.finditer(b"\xff\xd8\xff", content)), len(content)][:4]
    middle = (begin + end) // 2
    damaged.write_bytes(content[:middle] + bytes(300) + content[middle + 300 :])
    camera = open_camera(CameraName.FRONT, settings(source), clock=lambda: 0.0)
    first = camera.latest(0.0)

    with pytest.raises(DriverError, match="is no whole picture: its data is damaged") as caught:
        camera.latest(1 / RATE_HZ)
    last = camera.latest(2 / RATE_HZ)

    assert caught.value.fault is FaultKind.CAMERA_UNPLUGGED
    assert first is not None and last is not None and last.sequence == first.sequence + 2
    assert capfd.readouterr().err == ""
