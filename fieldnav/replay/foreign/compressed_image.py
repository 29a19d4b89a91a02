"""Pictures as sensor_msgs/CompressedImage and foxglove.CompressedImage hold them: JPEG or PNG.

The format of image_transport tells more than the compression: "rgb8; jpeg compressed bgr8" is a picture of
encoding rgb8 that was brought into the order blue green red before it was compressed.
"""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Image
from fieldnav.replay.foreign.raw_image import BAYER

BAYER_16 = {name.replace("8", "16"): pattern for name, pattern in BAYER.items()}
COLOURS = 3
LOW_BYTE_BITS = 8
"""Of two bytes a colour has, those that a camera of one byte would not have given."""
SWAPPED = "compressed rgb"
"""In the format: red and blue were compressed in each other's place."""
JPEG_BEGIN, JPEG_SCAN, JPEG_END = b"\xff\xd8", b"\xff\xda", b"\xff\xd9"
PNG_BEGIN, PNG_END = b"\x89PNG", b"IEND"
ALLOWED = "allowed are JPEG and PNG in colour, or of a Bayer pattern that the format names (bayer_rggb8; ...)"


def shows_its_colours(said: str) -> bool:
    """Whether a picture of this format shows the colours that it has without any further step."""
    return SWAPPED not in said and _encoding(said) not in BAYER | BAYER_16


def compressed_picture(data: bytes, said: str, name: str) -> Image:
    """The picture, shape (height, width, 3), blue green red; said: its format.

    Raises DriverError, beginning with the name, for what is not whole and for a picture without colour.
    """
    image = _decoded(data)
    if image is None:
        what = "is cut off" if _is_picture(data) else f"is no picture that can be read; {ALLOWED}"
        raise DriverError(f"{name}: format '{said}': {what}", FaultKind.CAMERA_UNPLUGGED)
    if image.ndim < COLOURS:
        pattern = (BAYER | BAYER_16).get(_encoding(said))
        if pattern is None:
            raise DriverError(f"{name}: format '{said}': is not in colour; {ALLOWED}", FaultKind.CAMERA_SIZE)
        image = np.asarray(cv2.cvtColor(image, pattern))
    if image.dtype == np.uint16:
        image = image >> LOW_BYTE_BITS
    if SWAPPED in said:
        image = np.ascontiguousarray(image[:, :, ::-1])
    return np.asarray(image, np.uint8)


def _encoding(said: str) -> str:
    """Of the picture before it was compressed; empty where the format does not tell."""
    encoding, separator, _ = said.partition(";")
    return encoding.strip() if separator else ""


def _decoded(data: bytes) -> NDArray[Any] | None:
    """With the channels and bytes a colour that it has, without transparency; None where it is not whole."""
    if not _is_whole(data):
        return None
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_ANYCOLOR | cv2.IMREAD_ANYDEPTH)
    except cv2.error:  # a head that claims more pixels than OpenCV allocates
        return None
    return None if image is None or image.dtype not in (np.uint8, np.uint16) else np.asarray(image)


def _is_picture(data: bytes) -> bool:
    return data.startswith((JPEG_BEGIN, PNG_BEGIN))


def _is_whole(data: bytes) -> bool:
    """Whether it has its end. Decoders fill what lacks of a JPEG with grey and say nothing.

    A JPEG's end comes after the last scan begins; a preview within it has an end of its own before that.
    """
    if data.startswith(JPEG_BEGIN):
        return data.rfind(JPEG_END) > data.rfind(JPEG_SCAN)
    return PNG_END in data if data.startswith(PNG_BEGIN) else bool(data)
