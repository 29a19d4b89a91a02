"""What the messages of each topic look like, said so that Foxglove needs no set-up."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.PoseInFrame_pb2 import PoseInFrame
from mcap.well_known import MessageEncoding, SchemaEncoding
from mcap_protobuf.schema import build_file_descriptor_set
from pydantic import BaseModel

from fieldnav.journal.entry import Line
from fieldnav.recording.message import Topic
from fieldnav.recording.plain_schema import plain_schema
from fieldnav.recording.records import Gap, Round, Stepped, Ticked

RECORDS: Mapping[Topic, type[BaseModel]] = {
    Topic.ROUND: Round,
    Topic.TICK: Ticked,
    Topic.STEP: Stepped,
    Topic.TRANSITION: Line,
    Topic.GAP: Gap,
}
"""Written as JSON."""

PROTOBUF: Mapping[Topic, Any] = {
    Topic.LOG: Log,
    Topic.POSE: PoseInFrame,
    Topic.FRONT_IMAGE: CompressedImage,
    Topic.REAR_IMAGE: CompressedImage,
    Topic.FRONT_OVERLAY: ImageAnnotations,
    Topic.REAR_OVERLAY: ImageAnnotations,
    Topic.FRONT_CALIBRATION: CameraCalibration,
    Topic.REAR_CALIBRATION: CameraCalibration,
}
"""Written as Foxglove's own messages."""


@dataclass(frozen=True, slots=True)
class Schema:
    """A schema, how it is written, and how the messages that follow it are."""

    name: str
    encoding: str
    data: bytes
    message_encoding: str


@cache
def schema_of(topic: Topic) -> Schema:
    """The schema of a topic's messages."""
    if topic in RECORDS:
        record = RECORDS[topic]
        data = json.dumps(plain_schema(record.model_json_schema(mode="serialization"))).encode()
        return Schema(f"fieldnav.{record.__name__}", SchemaEncoding.JSONSchema, data, MessageEncoding.JSON)
    message = PROTOBUF[topic]
    data = build_file_descriptor_set(message).SerializeToString()
    return Schema(message.DESCRIPTOR.full_name, SchemaEncoding.Protobuf, data, MessageEncoding.Protobuf)
