"""Pictures given on the command line: read and checked, their rows found, overlays written."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, degrees
from pathlib import Path
from time import perf_counter

import cv2
import numpy as np

from fieldnav.errors import OutputError, SettingsError
from fieldnav.journal.files import write_atomically
from fieldnav.messages import Image, RowLine
from fieldnav.perception.perceive import View, find
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import revised
from fieldnav.settings.regular_file import read_regular
from fieldnav.settings.robot import LARGEST_SIDE_PX, CameraSettings

LARGEST_FILE_BYTES = 4 * LARGEST_SIDE_PX**2
"""Of a picture; room for the largest one without compression and with an alpha channel."""
MILLISECONDS = 1000.0
OVERLAY_SUFFIX = "-rows.jpg"
OVERLAY_QUALITY = 92
"""Of the JPEG, per cent."""


@dataclass(frozen=True, slots=True)
class Detection:
    """A picture and what was found in it.

    camera: the robot's, at the picture's size; stride_px: from one place of the sliding window to the next.
    """

    path: str
    image: Image
    camera: Pinhole
    view: View
    stride_px: float
    milliseconds: float

    def angle_deg(self, row: RowLine) -> float:
        """A row's angle from the image's vertical, positive clockwise."""
        return degrees(atan2(row.x_top_px - row.x_bottom_px, self.camera.height_px - 1))


def check(path: str, settings: CameraSettings) -> None:
    """Raise SettingsError when the file is no picture that rows can be looked for in."""
    camera_of(read_picture(path), path, settings)


def read_picture(path: str) -> Image:
    """The picture in a file, shape (height, width, 3), blue green red. Raises SettingsError."""
    content = read_regular(path, LARGEST_FILE_BYTES)
    image = _decoded(content) if content else None
    if image is None:
        raise SettingsError(
            f"{path}: is no whole picture; allowed is JPEG, PNG, TIFF, BMP or WebP of at most "
            f"{LARGEST_SIDE_PX} px a side"
        )
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


def camera_of(image: Image, path: str, settings: CameraSettings) -> Pinhole:
    """The robot's camera as if its pictures had this size: the field of view stays.

    Raises SettingsError for a size that no camera has, and for one so tall that it shows the horizon.
    """
    size = {"width_px": image.shape[1], "height_px": image.shape[0]}
    return revised(settings, size, path).pinhole()


def detect_rows(path: str, crop: CropProfile, settings: CameraSettings) -> Detection:
    """Find every row of a picture; the time is that of the finding alone. Raises SettingsError."""
    image = read_picture(path)
    camera = camera_of(image, path, settings)
    started = perf_counter()
    view = find(image, crop, camera)
    milliseconds = (perf_counter() - started) * MILLISECONDS
    return Detection(path, image, camera, view, crop.finding.stride * camera.width_px, milliseconds)


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
