"""Pictures inside the page, as data."""

from base64 import b64encode
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from fieldnav.messages import Image
from fieldnav.settings.regular_file import open_regular

WIDTH_PX, QUALITY = 640, 72
"""Of a frame as it is shown: some 60 kB."""
PNG = b"\x89PNG"
MAP_WIDTH_PX, LARGEST_MAP_BYTES = 1400, 1_500_000


@dataclass(frozen=True, slots=True)
class Shown:
    """A picture as the page holds it."""

    uri: str
    width: int
    height: int
    caption: str


def shown(image: Image, caption: str) -> Shown:
    """A frame, scaled down."""
    small = _narrowed(image, WIDTH_PX)
    jpeg = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])[1].tobytes()
    return Shown(_uri("jpeg", jpeg), small.shape[1], small.shape[0], caption)


def map_uri(path: Path) -> str:
    """A map's picture inside the page, scaled down where it is large; empty when there is none."""
    try:
        with open_regular(path) as file:
            content = file.read()
    except OSError:
        return ""
    image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR) if content else None
    if image is None:
        return ""
    small = len(content) <= LARGEST_MAP_BYTES and content.startswith(PNG)
    return _uri("png", content if small else _png(_narrowed(image.astype(np.uint8), MAP_WIDTH_PX)))


def _png(image: Image) -> bytes:
    return cv2.imencode(".png", image)[1].tobytes()


def _narrowed(image: Image, width_px: int) -> Image:
    height, width = image.shape[:2]
    if width <= width_px:
        return image
    size = (width_px, max(1, round(height * width_px / width)))
    return cv2.resize(image, size, interpolation=cv2.INTER_AREA).astype(np.uint8)


def _uri(kind: str, content: bytes) -> str:
    return f"data:image/{kind};base64,{b64encode(content).decode()}"
