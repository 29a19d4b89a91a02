"""A robot that rolls along one lane and past its end at a steady speed, recorded in every way."""

import io
import json
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from google.protobuf.timestamp_pb2 import Timestamp
from mcap_protobuf.writer import Writer as McapWriter
from rosbags.rosbag1 import Writer as Bag1Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Bag2Writer
from rosbags.typesys import Stores, get_typestore

from fieldnav.cli.replay_foreign import Foreign, replay_foreign
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.evaluation.row_end_robot import ObedientWheels, TickingWorld
from fieldnav.messages import CameraName, Direction, Image, Side, Wheel, WheelSetpoint
from fieldnav.mission.loop import TICK_S
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import module_errors

SPEED_MPS, WAY_M = 0.5, 7.5
LANE_M = 4.0
CLEAR_SEED = 3
"""No two transitions come about within the same few frames."""
BEGUN_NS = 1_750_000_000_000_000_000
NS_PER_S = 1_000_000_000
RATE_HZ = 15
TOPICS = {CameraName.FRONT: "/front/image_raw", CameraName.REAR: "/rear/image_raw/compressed"}
ODOMETRY = "/odom"
RAW, COMPRESSED, MOVED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage", "nav_msgs/msg/Odometry"
LATE_NS = 20_000_000
"""From the stamp in the header until a message is written."""
PADDING = 5


@dataclass(frozen=True, slots=True)
class Picture:
    camera: CameraName
    stamp_ns: int
    image: Image

    @property
    def jpeg(self) -> bytes:
        return cv2.imencode(".jpg", self.image, [cv2.IMWRITE_JPEG_QUALITY, 95])[1].tobytes()


@dataclass(frozen=True, slots=True)
class Drive:
    """What the cameras gave, in order, and how the robot lay in its lane, on average."""

    pictures: tuple[Picture, ...]
    offset_m: float

    def of(self, camera: CameraName) -> list[Picture]:
        return [each for each in self.pictures if each.camera is camera]


@pytest.fixture(scope="session")
def drive() -> Drive:
    whole = {"lost_frames": 0.0}  # a video has no stamps that would tell of them
    lane = {"lanes": 1, "length_m": LANE_M, "seed": CLEAR_SEED}
    field = revised(load_field("demo"), lane | {"camera_errors": whole})
    crop, robot = load_crop(field.crop), smaller(load_robot("bonnbot"), 4)
    plan = sow(field, crop, Side.RIGHT)
    wheels = ObedientWheels(module_errors(field.wheel_errors, field.seed, field.mirrored))
    world = TickingWorld(plan, field, robot, wheels)
    cameras = {name: SimulatedCamera(name, world, SketchRenderer(plan, field, crop)) for name in CameraName}
    wheels.command(0.0, dict.fromkeys(Wheel, WheelSetpoint(SPEED_MPS, 0.0)))
    pictures, offsets, newest = [], [], dict.fromkeys(CameraName, 0)
    for tick in range(1, round(WAY_M / SPEED_MPS / TICK_S)):
        world.advance(tick * TICK_S)
        offsets.append(float(plan.in_lane(0, np.array([world.now.pose.x_m, world.now.pose.y_m]))[1]))
        for name, camera in cameras.items():
            frame = camera.latest(world.now.stamp_s)
            if frame is not None and frame.sequence > newest[name]:
                newest[name] = frame.sequence
                pictures.append(Picture(name, BEGUN_NS + round(frame.stamp_s * NS_PER_S), frame.image))
    followed = offsets[: round(LANE_M / SPEED_MPS / TICK_S)]
    return Drive(tuple(pictures), sum(followed) / len(followed))


Clocks = Callable[[CameraName, int, int], tuple[int, int]]


def in_step(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
    """Stamps and times of writing as they truly were."""
    return at_ns, at_ns


class Recordings:
    """Writes a drive as others would; rear: with the rear camera, in a bag or an MCAP."""

    topics, odometry, rate_hz = TOPICS, ODOMETRY, RATE_HZ

    def __init__(self, drive: Drive, folder: Path) -> None:
        self._drive, self._folder = drive, folder

    def bag1(self, **changes: Any) -> str:
        """ROS 1; front raw, padded; rear compressed."""
        path, store = self._folder / "field.bag", get_typestore(Stores.ROS1_NOETIC)
        with Bag1Writer(path) as bag:
            self._fill(bag, store, store.serialize_ros1, changes)
        return str(path)

    def bag2(self, storage: StoragePlugin = StoragePlugin.SQLITE3, **changes: Any) -> str:
        """ROS 2, a folder."""
        path, store = self._folder / f"drive_{storage.name.lower()}", get_typestore(Stores.ROS2_HUMBLE)
        with Bag2Writer(path, version=9, storage_plugin=storage) as bag:
            self._fill(bag, store, store.serialize_cdr, changes)
        return str(path)

    def mcap(self, clocks: Clocks = in_step, only: slice = slice(None), **changes: Any) -> str:
        """Foxglove's compressed images, of both cameras.

        clocks: stamp and time of writing, by camera, number and true time. only: of the pictures in order.
        changes: to messages.
        """
        path = self._folder / "other.mcap"
        numbers = dict.fromkeys(CameraName, 0)
        with path.open("wb") as file, McapWriter(file) as writer:
            for each in self._drive.pictures[only]:
                numbers[each.camera] += 1
                stamp_ns, written_ns = clocks(each.camera, numbers[each.camera], each.stamp_ns)
                seconds, nanos = divmod(stamp_ns, NS_PER_S)
                stamp = Timestamp(seconds=seconds, nanos=nanos)
                fields = {"timestamp": stamp, "data": each.jpeg, "format": "jpeg"} | changes
                writer.write_message(TOPICS[each.camera], CompressedImage(**fields), written_ns, written_ns)
        return str(path)

    def video(self, camera: CameraName = CameraName.FRONT) -> str:
        path = self._folder / f"{camera.value}.mp4"
        frames = self._drive.of(camera)
        height, width = frames[0].image.shape[:2]
        writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), RATE_HZ, (width, height))
        for each in frames:
            writer.write(each.image)
        writer.release()
        return str(path)

    def folder(self, camera: CameraName = CameraName.FRONT) -> str:
        path = self._folder / camera.value
        path.mkdir()
        for number, each in enumerate(self._drive.of(camera)):
            (path / f"{number}.jpg").write_bytes(each.jpeg)
        return str(path)

    def _fill(self, bag: Any, store: Any, serialize: Any, changes: dict[str, Any]) -> None:
        """Both cameras' pictures and the odometry; changes: to the front camera's messages."""
        ros = Ros(store)
        channel = {
            name: bag.add_connection(name, kind, typestore=store)
            for name, kind in zip((*TOPICS.values(), ODOMETRY), (RAW, COMPRESSED, MOVED), strict=True)
        }
        for each in self._drive.pictures:
            log_ns = each.stamp_ns + LATE_NS
            if each.camera is CameraName.FRONT:
                bag.write(channel[TOPICS[each.camera]], log_ns, serialize(ros.raw(each, **changes), RAW))
            else:
                bag.write(channel[TOPICS[each.camera]], log_ns, serialize(ros.compressed(each), COMPRESSED))
            bag.write(channel[ODOMETRY], log_ns, serialize(ros.odometry(each), MOVED))


class Ros:
    """The messages of one version of ROS."""

    def __init__(self, store: Any) -> None:
        self._types = store.types

    def raw(self, each: Picture, encoding: str = "rgb8", scale: float = 1.0) -> Any:
        """A picture without compression, each row padded."""
        image = cv2.resize(each.image, None, fx=scale, fy=scale) if scale != 1 else each.image
        pixels = image[:, :, ::-1] if encoding == "rgb8" else image
        padded = np.pad(pixels.reshape(image.shape[0], -1), ((0, 0), (0, PADDING)))
        height, width = image.shape[:2]
        return self._types[RAW](
            header=self._header(each),
            height=height,
            width=width,
            encoding=encoding,
            is_bigendian=0,
            step=padded.shape[1],
            data=padded.ravel(),
        )

    def compressed(self, each: Picture) -> Any:
        data = np.frombuffer(each.jpeg, np.uint8)
        return self._types[COMPRESSED](
            header=self._header(each), format="bgr8; jpeg compressed bgr8", data=data
        )

    def odometry(self, each: Picture) -> Any:
        kind = self._types
        vector, still = kind["geometry_msgs/msg/Vector3"], np.zeros(36)
        twist = kind["geometry_msgs/msg/Twist"](
            linear=vector(SPEED_MPS, 0.0, 0.0), angular=vector(0.0, 0.0, 0.0)
        )
        pose = kind["geometry_msgs/msg/Pose"](
            position=kind["geometry_msgs/msg/Point"](0.0, 0.0, 0.0),
            orientation=kind["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0),
        )
        return kind[MOVED](
            header=self._header(each),
            child_frame_id="base",
            pose=kind["geometry_msgs/msg/PoseWithCovariance"](pose=pose, covariance=still),
            twist=kind["geometry_msgs/msg/TwistWithCovariance"](twist=twist, covariance=still),
        )

    def _header(self, each: Picture) -> Any:
        header = self._types["std_msgs/msg/Header"]
        seconds, nanos = divmod(each.stamp_ns, NS_PER_S)
        stamp = self._types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=nanos)
        rest = {"seq": 0} if "seq" in header.__dataclass_fields__ else {}
        return header(stamp=stamp, frame_id=each.camera.value, **rest)


@pytest.fixture
def recordings(drive: Drive, tmp_path: Path) -> Recordings:
    return Recordings(drive, tmp_path)


def options(robot: Path, parent: Path, given: dict[str, Any]) -> Foreign:
    """Sugar beet, the small robot, and what else is given."""
    usual = Foreign(
        crop="sugar-beet",
        robot=str(robot),
        front=None,
        rear=None,
        odometry=None,
        speed_mps=SPEED_MPS,
        direction=Direction.FORWARD,
        rate_hz=None,
        lanes=None,
        side=Side.RIGHT,
        parent=parent,
    )
    return replace(usual, **given)


@pytest.fixture
def asked(quick_robot_file: Path, tmp_path: Path) -> Callable[..., Foreign]:
    """The options of a replay into the test's own folder."""
    return lambda **given: options(quick_robot_file, tmp_path / "runs", given)


@pytest.fixture
def replayed(
    asked: Callable[..., Foreign], capsys: pytest.CaptureFixture[str]
) -> Callable[..., dict[str, Any]]:
    """Replays a recording; what `--json` prints. status: 1 where much of it was not looked at."""

    def replayed(source: str, status: int = 0, **given: Any) -> dict[str, Any]:
        assert replay_foreign(source, asked(**given), as_json=True) == status
        document: dict[str, Any] = json.loads(capsys.readouterr().out)
        return document

    return replayed


@dataclass(frozen=True, slots=True)
class Kept:
    """A recording of both cameras that was replayed once for several tests."""

    run: Path
    said: str


Keeping = Callable[..., Kept]


@pytest.fixture(scope="session")
def keeping(drive: Drive, quick_robot_file: Path, tmp_path_factory: pytest.TempPathFactory) -> Keeping:
    """Writes a recording and replays it; the run's directory, and what was printed."""

    def keeping(write: Callable[[Recordings], str], as_json: bool) -> Kept:
        folder, said = tmp_path_factory.mktemp("kept"), io.StringIO()
        both = {camera.value: topic for camera, topic in TOPICS.items()}
        source = write(Recordings(drive, folder))
        with redirect_stdout(said):
            assert replay_foreign(source, options(quick_robot_file, folder / "runs", both), as_json) == 0
        (run,) = (folder / "runs").iterdir()
        return Kept(run, said.getvalue())

    return keeping
