"""The pictures of a topic."""

from collections.abc import Iterator
from functools import partial

from fieldnav.replay.foreign.compressed_image import compressed_picture, shows_its_colours
from fieldnav.replay.foreign.container import COMPRESSED, Container, Told
from fieldnav.replay.foreign.raw_image import raw_picture
from fieldnav.replay.foreign.shot import Shot

JPEG_BEGIN = b"\xff\xd8"


def images(container: Container, topic: str) -> Iterator[Shot]:
    """All pictures of a topic. Raises SettingsError on the way where the file is broken."""
    name = f"{container.name}: {topic}"
    return (_shot(told, name) for told in container.read(topic))


def _shot(told: Told, name: str) -> Shot:
    if told.type not in COMPRESSED:
        return Shot(name, told.stamp_ns, told.written_ns, partial(raw_picture, told.content, name))
    data, said = bytes(told.content.data), str(told.content.format)
    jpeg = data if data.startswith(JPEG_BEGIN) and shows_its_colours(said) else None
    return Shot(name, told.stamp_ns, told.written_ns, partial(compressed_picture, data, said, name), jpeg)
