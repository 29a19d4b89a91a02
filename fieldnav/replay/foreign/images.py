"""The pictures of a topic."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import cv2
import numpy as np

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Image
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
        return Shot(name, told.stamp_ns, partial(raw_picture, told.content, name))
    data = bytes(told.content.data)
    jpeg = data if data.startswith(JPEG_BEGIN) else None
    return Shot(name, told.stamp_ns, partial(_decoded, data, told.content, name), jpeg)


def _decoded(data: bytes, content: Any, name: str) -> Image:
    """The picture in a JPEG or PNG. Raises DriverError."""
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR) if data else None
    except cv2.error:  # a head that claims more pixels than OpenCV allocates
        image = None
    if image is None:
        said = f"{name}: format '{content.format}': is no picture that can be read; allowed are JPEG and PNG"
        raise DriverError(said, FaultKind.CAMERA_UNPLUGGED)
    return np.asarray(image, np.uint8)
