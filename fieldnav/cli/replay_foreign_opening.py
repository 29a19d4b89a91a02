"""Opens what `fieldnav replay` is given, when it is no run of ours."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

import cv2

from drivers.picture_folder import PICTURES
from fieldnav.cli.frames import frames_of
from fieldnav.cli.replay_foreign_options import FASTEST_HZ
from fieldnav.errors import SettingsError
from fieldnav.messages import CameraName
from fieldnav.replay.foreign.camera import ForeignCamera
from fieldnav.replay.foreign.container import Container, Told
from fieldnav.replay.foreign.images import images
from fieldnav.replay.foreign.joined import SUFFIX, Joined, mcap_files
from fieldnav.replay.foreign.mcap_file import McapFile
from fieldnav.replay.foreign.odometry import odometry
from fieldnav.replay.foreign.played import played
from fieldnav.replay.foreign.ros_bag import RosBag, is_bag
from fieldnav.replay.foreign.shot import Shot
from fieldnav.replay.foreign.steps import in_order
from fieldnav.replay.foreign.topics import image_topics, picture_topics
from fieldnav.settings.robot import Robot

if TYPE_CHECKING:
    from fieldnav.cli.replay_foreign import Foreign

OFF_BY, OFF_SHARE = 2, 0.02
"""The number of frames that a video's head tells is often reckoned from its length. Our choice."""


@dataclass(frozen=True, slots=True)
class Opened:
    """The cameras of a recording, how long it is, what tells of its motion, what of it is not looked at."""

    cameras: Mapping[CameraName, ForeignCamera]
    seconds: float
    odometry: Iterator[Told] | None = None
    notes: tuple[str, ...] = ()


def opened(source: str, asked: "Foreign", robot: Robot) -> Opened:
    """Open a bag, an MCAP file, a video or a folder of pictures. Raises SettingsError."""
    path = Path(source)
    if files := mcap_files(path):  # read by us, since rosbags wants every topic of them to be readable
        return _container(Joined(source, [McapFile(each) for each in files]), asked, robot)
    if is_bag(path):
        return _container(RosBag(path), asked, robot)
    if path.is_file() and path.suffix.lower() == SUFFIX:
        return _container(McapFile(path), asked, robot)
    return _pictures(source, asked, robot)


def _container(container: Container, asked: "Foreign", robot: Robot) -> Opened:
    if asked.rate_hz is not None:
        raise SettingsError(f"--rate: {container.name} has stamps; allowed is a rate for pictures and videos")
    given = {CameraName.FRONT: asked.front, CameraName.REAR: asked.rear}
    named = {camera: topic for camera, topic in given.items() if topic is not None}
    topics = image_topics(container, named, asked.direction.leading)
    cameras = {
        camera: ForeignCamera(
            camera, robot.cameras.get(camera), in_order(images(container, topic)), container.counts[topic]
        )
        for camera, topic in topics.items()
    }
    told = None if asked.odometry is None else odometry(container, asked.odometry)
    others = picture_topics(container).keys() - topics.values()
    notes = [f"not looked at: {topic}, {container.counts[topic]} pictures" for topic in sorted(others)]
    return Opened(cameras, container.seconds, told, tuple(notes))


def _pictures(source: str, asked: "Foreign", robot: Robot) -> Opened:
    """Videos or folders: the one that is named first is the front camera, or, alone, the one that leads."""
    for option, topic in (("--front", asked.front), ("--odometry", asked.odometry)):
        if topic is not None:
            raise SettingsError(f"{option} {topic}: {source} has no topics; allowed is to leave it out")
    front = CameraName.FRONT if asked.rear is not None else asked.direction.leading
    sources = {front: source} | ({} if asked.rear is None else {CameraName.REAR: asked.rear})
    cameras, seconds = {}, 0.0
    for camera, each in sources.items():
        shots, count, lasts_s = _played(each, asked.rate_hz)
        off = 0 if Path(each).is_dir() else OFF_BY + round(OFF_SHARE * count)
        cameras[camera] = ForeignCamera(camera, robot.cameras.get(camera), shots, count, off)
        seconds = max(seconds, lasts_s)
    return Opened(cameras, seconds)


def _played(source: str, rate_hz: float | None) -> tuple[Iterator[Shot], int, float]:
    """The pictures, how many they are, how long they last."""
    frames = frames_of(source)
    if rate_hz is None:
        rate_hz = _video_rate_hz(source)
    return played(frames.images, rate_hz), frames.expected, frames.expected / rate_hz


def _video_rate_hz(source: str) -> float:
    """A video's own rate. Raises SettingsError for a folder, which has none."""
    if Path(source).is_dir():
        raise SettingsError(
            f"{source}: is a folder of pictures ({', '.join(PICTURES)}), which come without times; "
            "allowed is to say how many were taken a second: --rate 15"
        )
    capture = cv2.VideoCapture(source)
    rate_hz = float(capture.get(cv2.CAP_PROP_FPS))
    capture.release()
    if not (isfinite(rate_hz) and 0 < rate_hz <= FASTEST_HZ):
        raise SettingsError(
            f"{source}: says {rate_hz:g} frames a second; "
            f"allowed is to give them with --rate, up to {FASTEST_HZ:g}"
        )
    return rate_hz
