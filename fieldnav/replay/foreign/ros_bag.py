"""A bag of ROS 1, or of ROS 2: a folder with its metadata.yaml, or its database alone."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from fieldnav.errors import SettingsError
from fieldnav.replay.foreign.container import Told, stamped
from fieldnav.replay.foreign.ros import rosbags
from fieldnav.replay.foreign.shot import NS_PER_S
from fieldnav.settings.one_line import one_line

METADATA = "metadata.yaml"
"""What makes a folder a bag of ROS 2."""
FILES = (".bag", ".db3")
ALLOWED = "allowed is a whole bag of ROS 1, indexed, or of ROS 2 with its metadata.yaml"


def is_bag(path: Path) -> bool:
    """Whether a path names a bag of either kind."""
    return path.suffix.lower() in FILES if path.is_file() else (path / METADATA).is_file()


class RosBag:
    """The Container over the rosbags package."""

    def __init__(self, path: Path) -> None:
        """Raises SettingsError where the package lacks, or the bag cannot be read."""
        self._path = path
        self._bags, types = rosbags(self.name)
        self._usual = types.get_typestore(types.Stores.LATEST)
        try:
            with self._reader() as reader:
                self._topics = {each.topic: str(each.msgtype) for each in reader.connections}
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
    def seconds(self) -> float:
        return self._seconds

    def read(self, topic: str) -> Iterator[Told]:
        try:
            with self._reader() as reader:
                wanted = [each for each in reader.connections if each.topic == topic]
                for connection, log_ns, data in reader.messages(wanted):
                    kind = connection.msgtype
                    yield stamped(log_ns, kind, reader.deserialize(data, kind))
        except Exception as error:  # as above
            raise self._broken(error) from error

    def _reader(self) -> Any:
        return self._bags.AnyReader([self._path], default_typestore=self._usual)

    def _broken(self, error: Exception) -> SettingsError:
        said = one_line(str(error)) or type(error).__name__
        return SettingsError(f"{self.name}: cannot be read: {said}; {ALLOWED}")
