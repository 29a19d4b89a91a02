"""Pictures without stamps, from a folder or a video: one every so often."""

from collections.abc import Iterator

from fieldnav.messages import Image
from fieldnav.replay.foreign.shot import NS_PER_S, Shot


def played(pictures: Iterator[tuple[str, Image]], rate_hz: float) -> Iterator[Shot]:
    """Each picture, with its name, at its time since the first."""
    for number, (name, image) in enumerate(pictures):
        at_ns = round(number * NS_PER_S / rate_hz)
        yield Shot(name, at_ns, at_ns, lambda image=image: image)  # type: ignore[misc]
