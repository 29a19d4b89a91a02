"""Foxglove's own messages as bytes: pictures, how a camera sees, where the robot is, what is to be read."""

from datetime import datetime
from enum import Enum
from math import cos, sin

from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.Pose_pb2 import Pose
from foxglove_schemas_protobuf.PoseInFrame_pb2 import PoseInFrame
from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3
from google.protobuf.timestamp_pb2 import Timestamp

from fieldnav.messages import CameraName
from fieldnav.pinhole import Pinhole

RUN_FRAME = "run"
"""The frame of the robot's pose: where the run began, x forward, y left."""

NO_DISTORTION = "plumb_bob"
STRAIGHT = (0.0,) * 5
UNROTATED = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


class Level(Enum):
    """How much a line of the log matters."""

    INFO = Log.INFO
    WARNING = Log.WARNING
    ERROR = Log.ERROR
    FATAL = Log.FATAL


def timestamp(utc: datetime) -> Timestamp:
    """A moment, which must know its time zone, as protobuf has it."""
    moment = Timestamp()
    moment.FromDatetime(utc)
    return moment


def compressed_image(camera: CameraName, utc: datetime, jpeg: bytes) -> bytes:
    """A picture, foxglove.CompressedImage."""
    image = CompressedImage(timestamp=timestamp(utc), frame_id=camera.value, data=jpeg, format="jpeg")
    return image.SerializeToString()


def jpeg_of(data: bytes) -> bytes:
    """The JPEG of a foxglove.CompressedImage. Raises DecodeError of protobuf for what is none."""
    return CompressedImage.FromString(data).data


def calibration(camera: CameraName, utc: datetime, pinhole: Pinhole) -> bytes:
    """How a camera sees, foxglove.CameraCalibration: a pinhole without distortion."""
    focal, x, y = pinhole.focal_px, pinhole.centre_x_px, pinhole.centre_y_px
    message = CameraCalibration(
        timestamp=timestamp(utc),
        frame_id=camera.value,
        width=pinhole.width_px,
        height=pinhole.height_px,
        distortion_model=NO_DISTORTION,
        D=STRAIGHT,
        K=(focal, 0, x, 0, focal, y, 0, 0, 1),
        R=UNROTATED,
        P=(focal, 0, x, 0, 0, focal, y, 0, 0, 0, 1, 0),
    )
    return message.SerializeToString()


def pose(utc: datetime, x_m: float, y_m: float, heading_rad: float) -> bytes:
    """Where the robot is, foxglove.PoseInFrame; heading counter-clockwise from the run's x axis."""
    half = heading_rad / 2
    at = Pose(position=Vector3(x=x_m, y=y_m), orientation=Quaternion(z=sin(half), w=cos(half)))
    return PoseInFrame(timestamp=timestamp(utc), frame_id=RUN_FRAME, pose=at).SerializeToString()


def log(utc: datetime, level: Level, name: str, message: str) -> bytes:
    """A line to read, foxglove.Log; name: of the part that says it."""
    return Log(timestamp=timestamp(utc), level=level.value, name=name, message=message).SerializeToString()
