"""Files of messages on topics: bags of ROS, and MCAP."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, islice
from typing import Any, Protocol

from fieldnav.replay.foreign.shot import NS_PER_S

ROS_IMAGE, ROS_COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
FOXGLOVE_IMAGE, FOXGLOVE_COMPRESSED = "foxglove.RawImage", "foxglove.CompressedImage"
ROS_ODOMETRY = "nav_msgs/msg/Odometry"

IMAGES = (ROS_IMAGE, ROS_COMPRESSED, FOXGLOVE_IMAGE, FOXGLOVE_COMPRESSED)
"""The types of pictures that are read, compressed or not."""
COMPRESSED = (ROS_COMPRESSED, FOXGLOVE_COMPRESSED)

Decoder = Callable[[bytes], Any]


@dataclass(frozen=True, slots=True)
class Written:
    """One message as a file holds it, and when it was written."""

    written_ns: int
    type: str
    content: Any


@dataclass(frozen=True, slots=True)
class Told:
    """One message with when what it tells of was so, by the clock of its headers, and when it was written."""

    stamp_ns: int
    written_ns: int
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
    def counts(self) -> Mapping[str, int]:
        """How many messages each topic has, as far as the file tells."""
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


def stamped(messages: Iterator[Written]) -> Iterator[Told]:
    """The messages with the stamps of their headers.

    A header without a stamp, or with the stamp of the message before, tells nothing. Then it counts when the
    message was written, on the headers' clock if one of the first two headers shows that. A stamp of 0 before
    a later one is the beginning of simulated time.
    """
    beginning = list(islice(messages, 2))
    heads = [_header_ns(each) for each in beginning]
    ahead_ns = next((head - each.written_ns for head, each in zip(heads, beginning, strict=True) if head), 0)
    before_ns = -1 if any(heads) else 0
    for each in chain(beginning, messages):
        head_ns = _header_ns(each)
        if head_ns == before_ns or (head_ns == 0 and before_ns > 0):
            stamp_ns = each.written_ns + ahead_ns
        else:
            stamp_ns, ahead_ns, before_ns = head_ns, head_ns - each.written_ns, head_ns
        yield Told(stamp_ns, each.written_ns, each.type, each.content)


def _header_ns(message: Written) -> int:
    if message.type.startswith("foxglove."):
        moment = message.content.timestamp
        return int(moment.seconds * NS_PER_S + moment.nanos)
    moment = message.content.header.stamp
    return int(moment.sec * NS_PER_S + moment.nanosec)
