"""The served cameras as others watch them: OpenCV's FFmpeg backend and plain HTTP."""

import time
import urllib.error
import urllib.request
from collections.abc import Callable
from urllib.parse import urlsplit

import cv2
import numpy as np
import pytest

from fieldnav.errors import SettingsError
from fieldnav.messages import CameraName
from fieldnav.simulation.served.picture_server import PictureServer
from fieldnav.simulation.served.served_robot import Offer, ServedRobot

LIMIT_S = 20.0
WIDTH_PX, HEIGHT_PX, RATE_HZ = 320, 180, 15


def address(served: ServedRobot, path: str) -> str:
    host, port = served.pictures.address
    return f"http://{host}:{port}{path}"


@pytest.mark.parametrize("name", list(CameraName))
def test_opencv_reads_the_motion_jpeg_at_its_size(name: CameraName, served: ServedRobot) -> None:
    capture = cv2.VideoCapture(served.robot.cameras.get(name).source, cv2.CAP_FFMPEG)
    try:
        images = [capture.read() for _ in range(5)]
    finally:
        capture.release()

    assert all(whole and image.shape == (HEIGHT_PX, WIDTH_PX, 3) for whole, image in images)
    assert all(image.std() > 5 for _, image in images), "something is to be seen"


@pytest.mark.parametrize("name", list(CameraName))
def test_a_single_picture(name: CameraName, served: ServedRobot) -> None:
    with urllib.request.urlopen(address(served, f"/{name.value}.jpg"), timeout=LIMIT_S) as answer:
        content = answer.read()

    image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR)
    assert answer.headers["Content-Type"] == "image/jpeg"
    assert image is not None and image.shape == (HEIGHT_PX, WIDTH_PX, 3)


def test_front_and_rear_show_different_places(served: ServedRobot) -> None:
    front, rear = (
        urllib.request.urlopen(address(served, path), timeout=LIMIT_S) for path in ("/front.jpg", "/rear.jpg")
    )
    with front, rear:
        assert front.read() != rear.read()


def test_a_picture_comes_no_sooner_than_the_cameras_latency_after_its_exposure(served: ServedRobot) -> None:
    ages_s: list[float] = []
    with urllib.request.urlopen(address(served, "/front.mjpg"), timeout=LIMIT_S) as stream:
        while len(ages_s) < 5:
            line = stream.readline()
            if line.startswith(b"X-Exposed:"):
                ages_s.append(served.now_s() - float(line.split(b":")[1]))

    assert min(ages_s) >= 0.07 - 0.001, "the stamp is told to the millisecond"
    assert min(ages_s) <= 0.07 + 0.5, "nor does it wait for anything else"


def test_a_watcher_that_was_slow_is_shown_the_newest_picture(
    served: ServedRobot, eventually: Callable[[Callable[[], object]], None]
) -> None:
    feed = served.feeds[CameraName.FRONT]
    with feed.watching():
        first = feed.newer_than(0)
        assert first is not None
        later = first.sequence + RATE_HZ // 2
        eventually(lambda: (newest := feed.newer_than(0)) is not None and newest.sequence >= later)

        after_first = feed.newer_than(first.sequence)

    assert after_first is not None and after_first.sequence >= later


def test_nothing_is_drawn_while_nobody_watches_and_old_pictures_are_not_shown(
    served: ServedRobot, eventually: Callable[[Callable[[], object]], None]
) -> None:
    feed = served.feeds[CameraName.FRONT]
    with feed.watching():
        before = feed.newer_than(0)
    stamp_s = served.world.now.stamp_s
    eventually(lambda: served.world.now.stamp_s > stamp_s + 0.3)

    with feed.watching():
        after = feed.newer_than(0)

    assert before is not None and after is not None
    assert after.stamp_s > stamp_s and after.sequence > before.sequence + 1


def test_what_is_not_there_is_not_found(served: ServedRobot) -> None:
    for path in ("/", "/left.mjpg", "/front.png", "/../etc/passwd"):
        with pytest.raises(urllib.error.HTTPError) as refusal:
            urllib.request.urlopen(address(served, path), timeout=LIMIT_S)
        with refusal.value as answer:
            assert answer.code == 404 and b"/front.mjpg" in answer.read()


def test_everything_listens_on_loopback_alone(served: ServedRobot) -> None:
    sources = [served.robot.cameras.get(name).source for name in CameraName]

    assert served.pictures.address[0] == served.hub.address[0] == "127.0.0.1"
    assert [urlsplit(source).hostname for source in sources] == ["127.0.0.1"] * 2


def test_watchers_are_let_go_at_the_end(offer: Offer) -> None:
    with ServedRobot(offer) as robot:
        feed = robot.feeds[CameraName.REAR]

    began_s = time.monotonic()
    with feed.watching():
        assert feed.newer_than(0) is None
    assert time.monotonic() - began_s < LIMIT_S


def test_a_port_that_is_taken_is_one_clear_line(served: ServedRobot) -> None:
    _, port = served.pictures.address

    with pytest.raises(SettingsError, match=f"^--port: {port}, for pictures, cannot be listened at: "):
        PictureServer(port, {})
