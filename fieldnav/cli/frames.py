"""Frames given on the command line, one after the other: a folder of pictures, or a video."""

import os
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from drivers.motion_jpeg import Capture, checked
from drivers.picture_folder import PICTURES, pictures_in
from fieldnav.cli.pictures import check_size, read_picture
from fieldnav.errors import PictureError, SettingsError
from fieldnav.messages import Image
from fieldnav.settings.shown_source import in_unicode

FFMPEG_LOG, SILENT = "OPENCV_FFMPEG_LOGLEVEL", "-8"
"""OpenCV reads this from the environment when it opens its first video."""
ALLOWED = "allowed is a folder of pictures, or a video that OpenCV reads"


@dataclass(frozen=True, slots=True)
class Frames:
    """expected: how many there are, as far as one can tell; images: (name, picture) each, of one size."""

    expected: int
    images: Iterator[tuple[str, Image]]


def frames_of(source: str) -> Frames:
    """The frames of a folder, by name, or of a video. Raises SettingsError, also while they are read."""
    if not source:
        raise SettingsError(f"'': is no name that a folder or a video can have; {ALLOWED}")
    try:
        mode = os.stat(source).st_mode
    except FileNotFoundError as error:
        raise SettingsError(f"{source}: there is no such folder or video") from error
    except OSError as error:
        raise SettingsError(f"{source}: cannot be read: {error.strerror}") from error
    except ValueError as error:  # a null byte
        raise SettingsError(f"{source!r}: is no name that a file can have") from error
    if stat.S_ISDIR(mode):
        return _of_folder(source)
    if not stat.S_ISREG(mode):
        raise SettingsError(f"{source}: is a pipe or a device; {ALLOWED}")
    if Path(source).suffix.lower() in PICTURES:
        raise SettingsError(f"{source}: is a single picture; {ALLOWED}")
    return _of_video(source)


def _of_folder(source: str) -> Frames:
    try:
        paths = [str(path) for path in pictures_in(Path(source))]
    except OSError as error:
        raise SettingsError(f"{source}: cannot be read: {error.strerror}") from error
    if not paths:
        raise SettingsError(f"{source}: holds no picture; allowed are {', '.join(PICTURES)}")
    return Frames(len(paths), _of_one_size((path, read_picture(path)) for path in paths))


def quiet_videos() -> None:
    """Keep FFmpeg's own words about a broken video off the terminal; to be called before one is opened."""
    os.environ.setdefault(FFMPEG_LOG, SILENT)


def _of_video(source: str) -> Frames:
    quiet_videos()
    try:
        with open(source, "rb"):
            pass
    except OSError as error:
        raise SettingsError(f"{source}: cannot be read: {error.strerror}") from error
    if not in_unicode(source):
        raise SettingsError(f"{source}: the name is no text, with which OpenCV opens no video; rename it")
    level = cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    try:
        capture = cv2.VideoCapture(source)
    finally:
        cv2.utils.logging.setLogLevel(level)
    if not capture.isOpened():
        raise SettingsError(f"{source}: is no video that can be read; {ALLOWED}")
    # A video's head need not tell the truth.
    return Frames(
        max(int(capture.get(cv2.CAP_PROP_FRAME_COUNT)), 1), _of_one_size(_played(source, checked(capture)))
    )


def _played(source: str, capture: Capture) -> Iterator[tuple[str, Image]]:
    try:
        number = 0
        while capture.grab():
            name = f"{source}: frame {number}"
            try:
                whole, image = capture.retrieve()
            except PictureError as error:
                if not capture.grab():  # the video is cut here
                    break
                raise SettingsError(f"{name}: {error}; {ALLOWED}") from error
            if not whole:
                break
            yield name, np.asarray(image, dtype=np.uint8)
            number += 1
    finally:
        capture.release()
    if number == 0:
        raise SettingsError(f"{source}: holds no frame that can be read; {ALLOWED}")


def _of_one_size(images: Iterator[tuple[str, Image]]) -> Iterator[tuple[str, Image]]:
    """The same frames; raises SettingsError for one that another camera took, or that no camera takes."""
    first: tuple[int, ...] | None = None
    for name, image in images:
        if first is None:
            check_size(image, name)
            first = image.shape
        if image.shape != first:
            sizes = [f"{width}x{height} px" for height, width, *_ in (image.shape, first)]
            raise SettingsError(f"{name}: is {sizes[0]}; allowed is {sizes[1]}, the size of the first frame")
        yield name, image
