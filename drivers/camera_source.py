"""What the `source` of a camera names, and how OpenCV opens it: quietly, and not waited for without end."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from enum import Enum, auto
from pathlib import Path
from threading import Lock

import cv2

from drivers.motion_jpeg import Capture
from drivers.picture_folder import PICTURES
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.settings.shown_source import PIPED, in_unicode, shown

STAMPED_STREAMS = ("rtsp://", "rtsps://")
STREAMS = (*STAMPED_STREAMS, "http://", "https://")
OPENING_S, READING_S, MILLISECONDS = 5, 2, 1000
"""A stream's key frames, without which it cannot be opened, come every few seconds; its frames always."""
TIMEOUTS = (
    cv2.CAP_PROP_OPEN_TIMEOUT_MSEC,
    OPENING_S * MILLISECONDS,
    cv2.CAP_PROP_READ_TIMEOUT_MSEC,
    READING_S * MILLISECONDS,
)
ONE_THREAD = (cv2.CAP_PROP_N_THREADS, 1)
"""Several decode several frames at a time, and each frame then waits for those after it."""
FFMPEG_OPTIONS = "OPENCV_FFMPEG_CAPTURE_OPTIONS"
LOW_LATENCY = "rtsp_transport;tcp|fflags;nobuffer|flags;low_delay"
"""Of what came in while the stream was looked at, nothing is given out: it would look fresh and be old."""
QUIET = {
    "OPENCV_FFMPEG_LOGLEVEL": "-8",  # FFmpeg's "quiet"
    "OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT": str(READING_S),
}
"""What OpenCV reads once from the environment, at its first video and at its first device."""

_streams_options = Lock()


class SourceKind(Enum):
    """What a source names."""

    DEVICE = auto()
    PIPELINE = auto()
    STREAM = auto()
    VIDEO = auto()
    PICTURE = auto()
    FOLDER = auto()


def kind_of(source: str) -> SourceKind:
    """Raises DriverError for what no camera can be, and OSError for a path that cannot be looked at."""
    if PIPED in source:
        return SourceKind.PIPELINE
    if source.lower().startswith(STREAMS):
        return SourceKind.STREAM
    if source.isdecimal():
        return SourceKind.DEVICE
    path = Path(source)
    if path.is_dir():
        return SourceKind.FOLDER
    if path.is_file():
        return SourceKind.PICTURE if path.suffix.lower() in PICTURES else SourceKind.VIDEO
    if path.is_fifo():
        raise _unplugged(f"{source}: is a pipe, which would be waited for without end")
    if not path.exists():
        raise _unplugged(f"{shown(source)}: there is no such device, video, picture or folder")
    return SourceKind.DEVICE


def brings_stamps(source: str) -> bool:
    """Whether frames say themselves when they were made; those by HTTP do not, and FFmpeg makes stamps up."""
    return source.lower().startswith(STAMPED_STREAMS)


def own_stamp_s(capture: Capture) -> float:
    """The stamp that the frame which was read last brought with it."""
    return capture.get(cv2.CAP_PROP_POS_MSEC) / MILLISECONDS


def quieten() -> None:
    """Keep OpenCV's and FFmpeg's own words off the terminal, and a silent device from being waited for long.

    Sets the environment: to be called before there are threads.
    """
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    for name, value in QUIET.items():
        os.environ.setdefault(name, value)
    os.environ.setdefault(FFMPEG_OPTIONS, "")


def open_capture(source: str, kind: SourceKind) -> cv2.VideoCapture:
    """A device, a pipeline, a stream or a video, opened. Raises DriverError."""
    if not in_unicode(source):
        raise _unplugged(f"{shown(source)}: the name is no text, with which OpenCV opens nothing; rename it")
    match kind:
        case SourceKind.PIPELINE:
            if not cv2.videoio_registry.hasBackend(cv2.CAP_GSTREAMER):
                raise _unplugged(f"{shown(source)}: is a GStreamer pipeline; this OpenCV has no GStreamer")
            capture = cv2.VideoCapture(source, cv2.CAP_GSTREAMER, TIMEOUTS)
        case SourceKind.STREAM:
            with _low_latency():
                capture = cv2.VideoCapture(source, cv2.CAP_FFMPEG, TIMEOUTS + ONE_THREAD)
        case SourceKind.DEVICE if source.isdecimal():
            capture = cv2.VideoCapture(int(source))
        case SourceKind.DEVICE:  # whatever else would open it would take it for a video
            capture = cv2.VideoCapture(source, cv2.CAP_V4L2)
        case _:
            capture = cv2.VideoCapture(source)
    if not capture.isOpened():
        raise _unplugged(f"{shown(source)}: cannot be opened as a camera or a video")
    return capture


@contextmanager
def _low_latency() -> Iterator[None]:
    """FFmpeg's options for a stream, unless the user has set others; a video would lose its first frames.

    OpenCV takes them from the environment alone. Their name stays there, since other threads may read the
    environment: another value may be put in at any time, a name not.
    """
    with _streams_options:
        own = os.environ.get(FFMPEG_OPTIONS)
        if own:
            yield
            return
        os.environ[FFMPEG_OPTIONS] = LOW_LATENCY
        try:
            yield
        finally:
            os.environ[FFMPEG_OPTIONS] = ""


def _unplugged(said: str) -> DriverError:
    return DriverError(said, FaultKind.CAMERA_UNPLUGGED)
