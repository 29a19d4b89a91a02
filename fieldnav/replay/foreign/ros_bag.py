"""A bag of ROS 1, or of ROS 2: a folder with its metadata.yaml, or its database alone."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from fieldnav.errors import SettingsError
from fieldnav.replay.foreign.container import Told, Written, stamped
from fieldnav.replay.foreign.joined import METADATA
from fieldnav.replay.foreign.ros import Definition, decoder, rosbags
from fieldnav.replay.foreign.shot import NS_PER_S
from fieldnav.settings.one_line import one_line

ROS1_SUFFIX = ".bag"
FILES = (ROS1_SUFFIX, ".db3")
ALLOWED = "allowed is a whole bag of ROS 1, indexed, or of ROS 2 with its metadata.yaml"


def is_bag(path: Path) -> bool:
    """Whether a path names a bag of either kind."""
    return path.suffix.lower() in FILES if path.is_file() else (path / METADATA).is_file()


class RosBag:
    """The Container over the rosbags package; of its topics only those that are asked for are decoded."""

    def __init__(self, path: Path) -> None:
        """Raises SettingsError where the package lacks, or the bag cannot be read."""
        self._path, self._rosbags = path, rosbags(str(path))
        self._ros1 = path.suffix.lower() == ROS1_SUFFIX
        try:
            with self._reader() as reader:
                self._topics = {each.topic: str(each.msgtype) for each in reader.connections}
                self._counts = {topic: int(each.msgcount) for topic, each in reader.topics.items()}
                self._seconds = max(0.0, float(reader.duration) / NS_PER_S)
        except Exception as error:  # of many kinds, for what is broken here and there
            raise self._broken(error) from error

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
        return self._seconds

    def read(self, topic: str) -> Iterator[Told]:
        return stamped(self._written(topic))

    def _written(self, topic: str) -> Iterator[Written]:
        kind = self._topics[topic]
        try:
            with self._reader() as reader:
                wanted = [each for each in reader.connections if (each.topic, each.msgtype) == (topic, kind)]
                decoders = {each.id: decoder(self.name, self._definition(each)) for each in wanted}
                for connection, written_ns, data in reader.messages(wanted):
                    yield Written(written_ns, kind, decoders[connection.id](data))
        except SettingsError:
            raise
        except Exception as error:  # as above
            raise self._broken(error) from error

    def _definition(self, connection: Any) -> Definition:
        idl = connection.msgdef.format.name == "IDL"
        return Definition(
            connection.msgtype, connection.msgdef.data, idl, self._ros1, connection.digest or ""
        )

    def _reader(self) -> Any:
        return (self._rosbags.bag1 if self._ros1 else self._rosbags.bag2).Reader(self._path)

    def _broken(self, error: Exception) -> SettingsError:
        said = one_line(str(error)) or type(error).__name__
        return SettingsError(f"{self.name}: cannot be read: {said}; {ALLOWED}")
