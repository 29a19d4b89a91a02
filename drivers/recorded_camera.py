"""A camera that plays what was recorded: a video, a folder of pictures, or one picture for ever."""

from pathlib import Path
from typing import Protocol

import numpy as np

from drivers.encoded_picture import decoded_picture
from drivers.motion_jpeg import Capture
from drivers.picture_folder import PICTURES, pictures_in
from fieldnav.errors import DriverError, PictureError, SettingsError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame, Image
from fieldnav.settings.camera import LARGEST_SIDE_PX, CameraSettings
from fieldnav.settings.regular_file import read_regular
from fieldnav.settings.shown_source import shown

COLOURS = 3
LARGEST_FILE_BYTES = 4 * LARGEST_SIDE_PX**2
"""Of a picture; room for the largest one without compression and with an alpha channel."""
ROUNDING = 1e-6  # of a frame: a time that is a frame's own must not fall short of it


class Reel(Protocol):
    """Pictures in their order."""

    def picture(self, index: int) -> Image | None:
        """The picture of an index that never falls; None past the last. Raises DriverError."""
        ...

    def close(self) -> None: ...


class RecordedCamera:
    """The Camera port over a reel, played at the robot file's rate from the moment it is first looked at.

    After the last picture that one is kept, and grows old like that of a camera which has stopped.
    """

    def __init__(self, name: CameraName, settings: CameraSettings, reel: Reel) -> None:
        self._name, self._settings, self._reel = name, settings, reel
        self._start_s: float | None = None
        self._index = -1
        self._frame: Frame | None = None

    def latest(self, now_s: float) -> Frame | None:
        """The picture whose time has come; those before it that nobody asked for are passed over."""
        start_s = self._start_s = now_s if self._start_s is None else self._start_s
        index = int((now_s - start_s) * self._settings.rate_hz + ROUNDING)
        if index > self._index:
            self._index = index
            image = self._reel.picture(index)
            if image is not None:
                check_size(image, self._settings)
                stamp_s = start_s + index / self._settings.rate_hz
                self._frame = Frame(self._name, index + 1, stamp_s, image)
        return self._frame

    def close(self) -> None:
        self._reel.close()


class Still:
    """One picture, again and again."""

    def __init__(self, path: Path) -> None:
        self._image = read_picture(path)

    def picture(self, index: int) -> Image | None:
        return self._image

    def close(self) -> None:
        """Nothing to give back."""


class Folder:
    """The pictures of a folder, one after the other."""

    def __init__(self, path: Path) -> None:
        self._paths = pictures_in(path)
        if not self._paths:
            said = f"{path}: holds no picture; allowed are {', '.join(PICTURES)}"
            raise DriverError(said, FaultKind.CAMERA_UNPLUGGED)

    def picture(self, index: int) -> Image | None:
        return read_picture(self._paths[index]) if index < len(self._paths) else None

    def close(self) -> None:
        """Nothing to give back."""


class Video:
    """The pictures of an opened video file; source: what messages call it."""

    def __init__(self, capture: Capture, source: str) -> None:
        self._capture, self._source = capture, source
        self._passed = -1

    def picture(self, index: int) -> Image | None:
        while self._passed < index:
            if not self._capture.grab():
                return None
            self._passed += 1
        try:
            whole, image = self._capture.retrieve()
        except PictureError as error:
            raise DriverError(
                f"{self._source}: frame {index}: {error}", FaultKind.CAMERA_UNPLUGGED
            ) from error
        return np.asarray(image, dtype=np.uint8) if whole else None

    def close(self) -> None:
        self._capture.release()


def read_picture(path: Path) -> Image:
    """The picture in a file, shape (height, width, 3), blue green red. Raises DriverError."""
    try:
        return decoded_picture(read_regular(str(path), LARGEST_FILE_BYTES))
    except SettingsError as error:
        raise DriverError(str(error), FaultKind.CAMERA_UNPLUGGED) from error
    except PictureError as error:
        raise DriverError(f"{path}: {error}", FaultKind.CAMERA_UNPLUGGED) from error


def check_size(image: Image, settings: CameraSettings) -> None:
    """Raise DriverError for a picture that is not of the robot file's size: every metre would be wrong."""
    wanted = settings.height_px, settings.width_px, COLOURS
    if image.shape != wanted:
        height, width, *colours = image.shape
        given = f"{width}x{height} px" + ("" if colours == [COLOURS] else " without colours")
        raise DriverError(
            f"{shown(settings.source)}: gives {given}; the robot file has width_px {settings.width_px} "
            f"and height_px {settings.height_px}",
            FaultKind.CAMERA_SIZE,
        )
