"""An MCAP file of others, with pictures of Foxglove's or of ROS's types."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
from mcap.reader import make_reader
from mcap.records import Schema
from mcap.well_known import MessageEncoding

from fieldnav.errors import SettingsError
from fieldnav.replay.foreign.container import (
    FOXGLOVE_COMPRESSED,
    FOXGLOVE_IMAGE,
    Decoder,
    Told,
    stamped,
)
from fieldnav.replay.foreign.ros import rosbags
from fieldnav.replay.foreign.shot import NS_PER_S
from fieldnav.settings.one_line import one_line

SUFFIX = ".mcap"
ALLOWED = "allowed is a whole MCAP file with its index, as `mcap recover` makes of a broken one"
FOXGLOVE: Mapping[str, Any] = {FOXGLOVE_COMPRESSED: CompressedImage, FOXGLOVE_IMAGE: RawImage}


class McapFile:
    """The Container over an MCAP file."""

    def __init__(self, path: Path) -> None:
        """Raises SettingsError where the file cannot be read."""
        self._path = path
        try:
            with path.open("rb") as file:
                summary = make_reader(file).get_summary()
        except Exception as error:  # of many kinds, for what is broken here and there
            raise self._broken(error) from error
        if summary is None or summary.statistics is None:
            raise self._broken(SettingsError("it has no index"))
        count = summary.statistics
        self._seconds = (count.message_end_time - count.message_start_time) / NS_PER_S
        schemas = summary.schemas
        self._topics = {
            each.topic: _type(schemas[each.schema_id].name, each.message_encoding)
            for each in summary.channels.values()
            if each.schema_id in schemas
        }

    @property
    def name(self) -> str:
        return str(self._path)

    @property
    def topics(self) -> Mapping[str, str]:
        return self._topics

    @property
    def seconds(self) -> float:
        return self._seconds

    def read(self, topic: str) -> Iterator[Told]:
        kind, decoder = self._topics[topic], None
        try:
            with self._path.open("rb") as file:
                for schema, channel, message in make_reader(file).iter_messages([topic]):
                    if schema is not None:
                        decoder = decoder or self._decoder(kind, schema, channel.message_encoding)
                        yield stamped(message.log_time, kind, decoder(message.data))
        except SettingsError:
            raise
        except Exception as error:  # as above
            raise self._broken(error) from error

    def _decoder(self, kind: str, schema: Schema, encoding: str) -> Decoder:
        """What makes messages of bytes. Raises SettingsError where rosbags is needed and lacks."""
        if encoding == MessageEncoding.Protobuf:
            made: Decoder = FOXGLOVE[kind].FromString
            return made
        _, types = rosbags(self.name)
        store = types.get_typestore(types.Stores.EMPTY)
        store.register(types.get_types_from_msg(schema.data.decode(), kind))
        read = store.deserialize_cdr if encoding == MessageEncoding.CDR else store.deserialize_ros1
        return lambda data: read(data, kind)

    def _broken(self, error: Exception) -> SettingsError:
        said = one_line(str(error)) or type(error).__name__
        return SettingsError(f"{self.name}: cannot be read: {said}; {ALLOWED}")


def _type(name: str, encoding: str) -> str:
    """The type of a topic, by ROS 2's name where it is one of ROS 1; no known one for JSON."""
    match encoding:
        case MessageEncoding.ROS1:
            return name.replace("/", "/msg/", 1)
        case MessageEncoding.CDR | MessageEncoding.Protobuf:
            return name
        case _:
            return f"{name} as {encoding}"
