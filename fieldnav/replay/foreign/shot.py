"""One picture of a recording, not decoded before somebody looks at it."""

from collections.abc import Callable
from dataclasses import dataclass

from fieldnav.messages import Image

NS_PER_S = 1_000_000_000


@dataclass(frozen=True, slots=True)
class Shot:
    """When it was taken and written, by the recording's own clocks, and how to decode it.

    name: what messages call it. picture: gives shape (height, width, 3), blue green red; raises DriverError.
    jpeg: its bytes, where it is one that shows the same colours.
    """

    name: str
    stamp_ns: int
    written_ns: int
    picture: Callable[[], Image]
    jpeg: bytes | None = None
