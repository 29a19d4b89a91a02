"""Files of messages on topics: bags of ROS, and MCAP."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from fieldnav.replay.foreign.shot import NS_PER_S

ROS_IMAGE, ROS_COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
FOXGLOVE_IMAGE, FOXGLOVE_COMPRESSED = "foxglove.RawImage", "foxglove.CompressedImage"
ROS_ODOMETRY = "nav_msgs/msg/Odometry"

IMAGES = (ROS_IMAGE, ROS_COMPRESSED, FOXGLOVE_IMAGE, FOXGLOVE_COMPRESSED)
"""The types of pictures that are read, compressed or not."""
COMPRESSED = (ROS_COMPRESSED, FOXGLOVE_COMPRESSED)


@dataclass(frozen=True, slots=True)
class Told:
    """One message, and when what it tells of was so: by its header, else when it was written."""

    stamp_ns: int
    type: str
    content: Any


class Container(Protocol):
    """A file of messages; each look at a topic begins at its beginning, and two may go on side by side."""

    @property
    def name(self) -> str:
        """What messages call it."""
        ...

    @property
    def topics(self) -> Mapping[str, str]:
        """The type of each topic's messages, by ROS 2's names."""
        ...

    @property
    def seconds(self) -> float:
        """How long it is."""
        ...

    def read(self, topic: str) -> Iterator[Told]:
        """All messages of a topic in the order in which they were written.

        Raises SettingsError, also on the way, where the file is broken.
        """
        ...


def stamped(log_ns: int, kind: str, content: Any) -> Told:
    """A message with the stamp of its header, if that has one."""
    if kind.startswith("foxglove."):
        moment = content.timestamp
        header_ns = moment.seconds * NS_PER_S + moment.nanos
    else:
        moment = content.header.stamp
        header_ns = moment.sec * NS_PER_S + moment.nanosec
    return Told(header_ns or log_ns, kind, content)


Decoder = Callable[[bytes], Any]
