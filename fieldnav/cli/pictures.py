"""Pictures given on the command line, read and checked, and pictures with rows drawn in, written."""

import os
from collections.abc import Sequence
from pathlib import Path

import cv2
from pydantic import Field

from drivers.encoded_picture import decoded_picture
from drivers.recorded_camera import LARGEST_FILE_BYTES
from fieldnav.cli.output_folder import make_writable
from fieldnav.errors import PictureError, SettingsError
from fieldnav.journal.files import check_replaceable, write_atomically
from fieldnav.messages import Image
from fieldnav.perception.pose.picture_quality import BLACK, WHITE
from fieldnav.settings.camera import LARGEST_SIDE_PX
from fieldnav.settings.loading import revised
from fieldnav.settings.model import Settings
from fieldnav.settings.regular_file import read_regular

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
    if not path:
        raise SettingsError("'': is no name that a file can have")
    try:
        image = decoded_picture(read_regular(path, LARGEST_FILE_BYTES))
    except PictureError as error:
        raise SettingsError(
            f"{path}: {error}; allowed is JPEG, PNG, TIFF, BMP or WebP of at most {LARGEST_SIDE_PX} px a side"
        ) from error
    check_size(image, path)
    return image


def check_size(image: Image, name: str) -> None:
    """Raise SettingsError, naming `name`, for a picture too small or too large to look for rows in."""
    revised(PictureSize(), {"width_px": image.shape[1], "height_px": image.shape[0]}, name)


def unlit(image: Image) -> str:
    """Why no robot would go by a picture so dark or so bright; empty for one that it would go by."""
    brightness = float(image.mean())
    if BLACK <= brightness <= WHITE:
        return ""
    colour = "black" if brightness < BLACK else "white"
    return (
        f"is nearly {colour}: brightness {brightness:.1f} of 255; a robot goes by {BLACK:.0f} to {WHITE:.0f}"
    )


def overlay_paths(images: Sequence[str], folder: Path) -> dict[str, Path]:
    """Where each picture's overlay goes, over none of the pictures themselves. Raises OutputError.

    The folder is made if it lacks.
    """
    make_writable(folder, f"--overlay {folder}:")
    given = {os.path.realpath(image) for image in images}
    paths: dict[str, Path] = {}
    for image in dict.fromkeys(images):
        path, number = folder / f"{Path(image).stem}{OVERLAY_SUFFIX}", 1
        while path in paths.values() or os.path.realpath(path) in given:
            number += 1
            path = folder / f"{Path(image).stem}-{number}{OVERLAY_SUFFIX}"
        check_replaceable(path)
        paths[image] = path
    return paths


def write_picture(path: Path, image: Image) -> None:
    """Write a JPEG whole or not at all. Raises OutputError."""
    _, content = cv2.imencode(path.suffix, image, [cv2.IMWRITE_JPEG_QUALITY, OVERLAY_QUALITY])
    write_atomically(path, content.tobytes())
