"""Pictures as sensor_msgs/Image and foxglove.RawImage hold them: bytes, row by row."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Image

CHANNELS = {
    "bgr8": 3,
    "rgb8": 3,
    "8UC3": 3,
    "bgra8": 4,
    "rgba8": 4,
    "yuyv": 2,
    "yuv422_yuy2": 2,
    "uyvy": 2,
    "yuv422": 2,
}
"""Bytes of a pixel, by the names that ROS and Foxglove have for the encodings in colour."""
BAYER = {
    "bayer_rggb8": cv2.COLOR_BayerBG2BGR,
    "bayer_bggr8": cv2.COLOR_BayerRG2BGR,
    "bayer_gbrg8": cv2.COLOR_BayerGR2BGR,
    "bayer_grbg8": cv2.COLOR_BayerGB2BGR,
}
"""ROS names the first two pixels of the first two rows; OpenCV those of the second ones."""
COLOURS = {
    "rgb8": cv2.COLOR_RGB2BGR,
    "bgra8": cv2.COLOR_BGRA2BGR,
    "rgba8": cv2.COLOR_RGBA2BGR,
    "yuyv": cv2.COLOR_YUV2BGR_YUY2,
    "yuv422_yuy2": cv2.COLOR_YUV2BGR_YUY2,
    "uyvy": cv2.COLOR_YUV2BGR_UYVY,
    "yuv422": cv2.COLOR_YUV2BGR_UYVY,
}
KNOWN = (*CHANNELS, *BAYER)


def raw_picture(message: Any, name: str) -> Image:
    """The picture, shape (height, width, 3), blue green red.

    Raises DriverError, beginning with the name, for an encoding without colours and for too few bytes.
    """
    encoding = str(message.encoding)
    if encoding not in KNOWN:
        said = f"{name}: encoding {encoding}: is not in colour, or not known; allowed are {', '.join(KNOWN)}"
        raise DriverError(said, FaultKind.CAMERA_SIZE)
    pixels = _pixels(message, CHANNELS.get(encoding, 1), name)
    if encoding in BAYER:
        return np.asarray(cv2.cvtColor(pixels[:, :, 0], BAYER[encoding]), np.uint8)
    if encoding in COLOURS:
        return np.asarray(cv2.cvtColor(pixels, COLOURS[encoding]), np.uint8)
    return pixels


def _pixels(message: Any, channels: int, name: str) -> NDArray[np.uint8]:
    """The bytes as shape (height, width, channels), without what pads each row. Raises DriverError."""
    height, width, step = int(message.height), int(message.width), int(message.step)
    data = np.frombuffer(message.data, np.uint8)
    used = width * channels
    if not 0 < used <= step or not 0 < height * step <= data.size:
        raise DriverError(
            f"{name}: {width}x{height} px at step {step} does not fit its {data.size} bytes",
            FaultKind.CAMERA_UNPLUGGED,
        )
    rows = data[: height * step].reshape(height, step)[:, :used]
    return np.ascontiguousarray(rows).reshape(height, width, channels)
