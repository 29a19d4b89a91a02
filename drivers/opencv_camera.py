"""The camera of a robot file: a device, a pipeline or a stream, live, or what a camera has recorded."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import cv2

from drivers.camera_source import SourceKind, brings_stamps, kind_of, open_capture, own_stamp_s, quieten
from drivers.live_camera import LiveCamera
from drivers.motion_jpeg import Capture, checked
from drivers.ports import Camera
from drivers.recorded_camera import Folder, RecordedCamera, Still, Video
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName
from fieldnav.settings.camera import CameraSettings
from fieldnav.settings.shown_source import shown


def open_camera(
    name: CameraName, settings: CameraSettings, clock: Callable[[], float], quality: int | None = None
) -> Camera:
    """The camera of a robot file; `clock` is the one that the loop goes by, `quality` see LiveCamera.

    Raises DriverError, which names the source without its password, when it cannot be opened.
    """
    quieten()
    try:
        return _opened(name, settings, clock, quality)
    except DriverError as error:
        raise DriverError(f"{name.value} camera: {error}", error.fault) from error
    except OSError as error:
        said = f"{name.value} camera: {shown(settings.source)}: cannot be read: {error.strerror}"
        raise DriverError(said, FaultKind.CAMERA_UNPLUGGED) from error


def _opened(
    name: CameraName, settings: CameraSettings, clock: Callable[[], float], quality: int | None
) -> Camera:
    source, kind = settings.source, kind_of(settings.source)
    match kind:
        case SourceKind.FOLDER:
            return RecordedCamera(name, settings, Folder(Path(source)))
        case SourceKind.PICTURE:
            return RecordedCamera(name, settings, Still(Path(source)))
        case SourceKind.VIDEO:
            return RecordedCamera(name, settings, Video(checked(open_capture(source, kind)), source))
        case SourceKind.DEVICE:
            opener = partial(_tuned, source, kind, settings)
        case SourceKind.PIPELINE | SourceKind.STREAM:  # they say themselves what they give
            opener = partial(_streamed, source, kind)
    own_stamp = own_stamp_s if brings_stamps(source) else None
    return LiveCamera(name, settings, opener, clock, quality=quality, own_stamp=own_stamp)


def _streamed(source: str, kind: SourceKind) -> Capture:
    return checked(open_capture(source, kind))


def _tuned(source: str, kind: SourceKind, settings: CameraSettings) -> Capture:
    """Ask a device for the robot file's size and rate; what it makes of that shows in its frames."""
    capture = open_capture(source, kind)
    # Raw pictures of 1280x720 do not go through USB 2 at 15 a second.
    capture.set(cv2.CAP_PROP_FOURCC, cv2.VideoWriter.fourcc(*"MJPG"))
    capture.set(cv2.CAP_PROP_FRAME_WIDTH, settings.width_px)
    capture.set(cv2.CAP_PROP_FRAME_HEIGHT, settings.height_px)
    capture.set(cv2.CAP_PROP_FPS, settings.rate_hz)
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
    return checked(capture)
