"""Pictures as JPEG: a camera's frames as they are recorded, so that a replay sees what the robot saw.

JPEG loses a little. What is recorded is therefore compressed first, and the mission goes by what comes out of
that: only so can the same picture be looked at again, bit for bit.
"""

from dataclasses import replace

import cv2
import numpy as np

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Frame, Image


def compressed(frame: Frame, quality: int) -> Frame:
    """The frame with its JPEG, and with the picture that this gives; one that has its JPEG stays as it is."""
    if frame.jpeg is not None:
        return frame
    whole, content = cv2.imencode(".jpg", frame.image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    assert whole, "a picture of bytes in three colours can always be compressed"
    jpeg = content.tobytes()
    return replace(frame, image=decoded(jpeg), jpeg=jpeg)


def decoded(jpeg: bytes) -> Image:
    """The picture in a JPEG, shape (height, width, 3), blue green red. Raises DriverError."""
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR) if jpeg else None
    if image is None:
        raise DriverError("a recorded picture cannot be decoded", FaultKind.CAMERA_UNPLUGGED)
    return np.asarray(image, dtype=np.uint8)
