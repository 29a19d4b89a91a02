"""Pictures given on the command line, read and checked, and pictures with rows drawn in, written."""

import tempfile
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from pydantic import Field

from fieldnav.errors import OutputError, SettingsError
from fieldnav.journal.files import write_atomically
from fieldnav.messages import Image
from fieldnav.settings.loading import revised
from fieldnav.settings.model import Settings
from fieldnav.settings.regular_file import read_regular
from fieldnav.settings.robot import LARGEST_SIDE_PX

LARGEST_FILE_BYTES = 4 * LARGEST_SIDE_PX**2
"""Of a picture; room for the largest one without compression and with an alpha channel."""
SMALLEST_WIDTH_PX, SMALLEST_HEIGHT_PX = 64, 48
"""The least that a robot's camera may have."""
OVERLAY_SUFFIX = "-rows.jpg"
OVERLAY_QUALITY = 92
"""Of the JPEG, per cent."""


class PictureSize(Settings):
    """The size of a picture in which rows can be looked for, whatever camera took it."""

    width_px: int = Field(default=SMALLEST_WIDTH_PX, ge=SMALLEST_WIDTH_PX, le=LARGEST_SIDE_PX)
    height_px: int = Field(default=SMALLEST_HEIGHT_PX, ge=SMALLEST_HEIGHT_PX, le=LARGEST_SIDE_PX)


def read_picture(path: str) -> Image:
    """The picture in a file, shape (height, width, 3), blue green red. Raises SettingsError."""
    content = read_regular(path, LARGEST_FILE_BYTES)
    image = _decoded(content) if content else None
    if image is None:
        raise SettingsError(
            f"{path}: is no whole picture; allowed is JPEG, PNG, TIFF, BMP or WebP of at most "
            f"{LARGEST_SIDE_PX} px a side"
        )
    revised(PictureSize(), {"width_px": image.shape[1], "height_px": image.shape[0]}, path)
    return image


def _decoded(content: bytes) -> Image | None:
    """The picture that the bytes hold, if they hold one; OpenCV's own words about it are kept quiet."""
    level = cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    try:
        image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR)
    except cv2.error:  # a head that claims more pixels than OpenCV allocates
        return None
    finally:
        cv2.utils.logging.setLogLevel(level)
    return None if image is None else np.asarray(image, dtype=np.uint8)


def overlay_paths(images: Sequence[str], folder: Path) -> dict[str, Path]:
    """Where each picture's overlay goes; the folder is made if it lacks. Raises OutputError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise OutputError(
            f"{folder}: overlays cannot be written here: {error.strerror}; allowed is a folder you can write"
        ) from error
    paths: dict[str, Path] = {}
    for image in dict.fromkeys(images):
        path, number = folder / f"{Path(image).stem}{OVERLAY_SUFFIX}", 1
        while path in paths.values():
            number += 1
            path = folder / f"{Path(image).stem}-{number}{OVERLAY_SUFFIX}"
        paths[image] = path
    return paths


def write_picture(path: Path, image: Image) -> None:
    """Write a JPEG whole or not at all. Raises OutputError."""
    _, content = cv2.imencode(path.suffix, image, [cv2.IMWRITE_JPEG_QUALITY, OVERLAY_QUALITY])
    write_atomically(path, content.tobytes())
