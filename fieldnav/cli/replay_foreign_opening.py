"""Opens what `fieldnav replay` is given, when it is no run of ours."""

from collections.abc import Callable, Iterator, Mapping
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
from fieldnav.replay.foreign.container import Container
from fieldnav.replay.foreign.images import images
from fieldnav.replay.foreign.mcap_file import SUFFIX, McapFile
from fieldnav.replay.foreign.odometry import ToldTwist, odometry
from fieldnav.replay.foreign.played import played
from fieldnav.replay.foreign.ros_bag import RosBag, is_bag
from fieldnav.replay.foreign.shot import Shot
from fieldnav.replay.foreign.topics import image_topics
from fieldnav.replay.foreign.wheels import Moved
from fieldnav.settings.robot import Robot

if TYPE_CHECKING:
    from fieldnav.cli.replay_foreign import Foreign


@dataclass(frozen=True, slots=True)
class Opened:
    """The cameras of a recording, how long it is, and what tells of its motion from a beginning in ns on."""

    cameras: Mapping[CameraName, ForeignCamera]
    seconds: float
    odometry: Callable[[int], Moved] | None = None


def opened(source: str, asked: "Foreign", robot: Robot) -> Opened:
    """Open a bag, an MCAP file, a video or a folder of pictures. Raises SettingsError."""
    path = Path(source)
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
        camera: ForeignCamera(camera, robot.cameras.get(camera), images(container, topic))
        for camera, topic in topics.items()
    }
    if asked.odometry is None:
        return Opened(cameras, container.seconds)
    told = odometry(container, asked.odometry)
    return Opened(cameras, container.seconds, lambda begun_ns: ToldTwist(told, begun_ns))


def _pictures(source: str, asked: "Foreign", robot: Robot) -> Opened:
    """Videos or folders: the one that is named first is the front camera, or, alone, the one that leads."""
    for option, topic in (("--front", asked.front), ("--odometry", asked.odometry)):
        if topic is not None:
            raise SettingsError(f"{option} {topic}: {source} has no topics; allowed is to leave it out")
    front = CameraName.FRONT if asked.rear is not None else asked.direction.leading
    sources = {front: source} | ({} if asked.rear is None else {CameraName.REAR: asked.rear})
    cameras, seconds = {}, 0.0
    for camera, each in sources.items():
        shots, lasts_s = _played(each, asked.rate_hz)
        cameras[camera] = ForeignCamera(camera, robot.cameras.get(camera), shots)
        seconds = max(seconds, lasts_s)
    return Opened(cameras, seconds)


def _played(source: str, rate_hz: float | None) -> tuple[Iterator[Shot], float]:
    frames = frames_of(source)
    if rate_hz is None:
        rate_hz = _video_rate_hz(source)
    return played(frames.images, rate_hz), frames.expected / rate_hz


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
