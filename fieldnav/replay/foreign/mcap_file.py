"""An MCAP file of others, with pictures of Foxglove's or of ROS's types."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
from mcap.records import Channel
from mcap.well_known import MessageEncoding

from fieldnav.errors import SettingsError
from fieldnav.replay.foreign.container import (
    FOXGLOVE_COMPRESSED,
    FOXGLOVE_IMAGE,
    Decoder,
    Told,
    Written,
    stamped,
)
from fieldnav.replay.foreign.mcap_index import McapIndex, counts_of, index_of, messages_at
from fieldnav.replay.foreign.ros import Definition, decoder
from fieldnav.replay.foreign.shot import NS_PER_S
from fieldnav.settings.one_line import one_line

ALLOWED = "allowed is a whole MCAP file, as `mcap recover` makes of a broken one"
FOXGLOVE: Mapping[str, Any] = {FOXGLOVE_COMPRESSED: CompressedImage, FOXGLOVE_IMAGE: RawImage}
NO_SCHEMA = "messages without a schema"


class McapFile:
    """The Container over an MCAP file; of its topics only those that are asked for are decoded."""

    def __init__(self, path: Path) -> None:
        """Raises SettingsError where the file cannot be read."""
        self._path = path
        try:
            with path.open("rb") as file:
                self._index = index_of(file)
        except Exception as error:  # of many kinds, for what is broken here and there
            raise self._broken(str(error) or type(error).__name__) from error
        if self._index.damage and not self._index.channels:
            raise self._broken(self._index.damage)
        self._topics = {each.topic: _type(self._index, each) for each in self._index.channels.values()}
        self._counts = counts_of(self._index)

    @property
    def name(self) -> str:
        return str(self._path)

    @property
    def topics(self) -> Mapping[str, str]:
        return self._topics

    @property
    def counts(self) -> Mapping[str, int]:
        return self._counts

    @property
    def seconds(self) -> float:
        return (self._index.last_ns - self._index.first_ns) / NS_PER_S

    def read(self, topic: str) -> Iterator[Told]:
        return stamped(self._written(topic))

    def _written(self, topic: str) -> Iterator[Written]:
        kind, index = self._topics[topic], self._index
        wanted = {
            number: each
            for number, each in index.channels.items()
            if each.topic == topic and _type(index, each) == kind
        }
        try:
            decoders = {number: self._decoder(kind, each) for number, each in wanted.items()}
            with self._path.open("rb") as file:
                for place in index.places:
                    if place.channels is not None and place.channels.isdisjoint(wanted):
                        continue
                    for message in messages_at(file, place):
                        if message.channel in wanted:
                            yield Written(message.written_ns, kind, decoders[message.channel](message.data))
        except SettingsError:
            raise
        except Exception as error:  # as above
            raise self._broken(str(error) or type(error).__name__) from error
        if index.damage:
            raise self._broken(index.damage)

    def _decoder(self, kind: str, channel: Channel) -> Decoder:
        """What makes messages of bytes. Raises SettingsError where rosbags is needed and lacks."""
        encoding = channel.message_encoding
        if encoding == MessageEncoding.Protobuf:
            made: Decoder = FOXGLOVE[kind].FromString
            return made
        schema = self._index.schemas[channel.schema_id]
        text = schema.data.decode(errors="replace")
        return decoder(
            self.name, Definition(kind, text, "idl" in schema.encoding, encoding == MessageEncoding.ROS1)
        )

    def _broken(self, said: str) -> SettingsError:
        return SettingsError(f"{self.name}: cannot be read: {one_line(said)}; {ALLOWED}")


def _type(index: McapIndex, channel: Channel) -> str:
    """The type of a topic, by ROS 2's name where it is one of ROS 1; no known one for JSON."""
    schema = index.schemas.get(channel.schema_id)
    if schema is None:
        return NO_SCHEMA
    match channel.message_encoding:
        case MessageEncoding.ROS1:
            return schema.name.replace("/", "/msg/", 1)
        case MessageEncoding.CDR | MessageEncoding.Protobuf:
            return schema.name
        case _:
            return f"{schema.name} as {channel.message_encoding}"
