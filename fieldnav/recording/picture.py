"""A recorded picture, decoded when it is asked for."""

from dataclasses import dataclass

import cv2
import numpy as np
from google.protobuf.message import DecodeError

from fieldnav.errors import FieldnavError
from fieldnav.messages import Image
from fieldnav.recording.foxglove import jpeg_of
from fieldnav.recording.piece import MOST_SEQUENCE
from fieldnav.recording.records import Seen


@dataclass(frozen=True, slots=True)
class Picture:
    """Which frame, and its JPEG."""

    seen: Seen
    jpeg: bytes

    def image(self) -> Image:
        """The picture, shape (height, width, 3), blue green red. Raises FieldnavError for no picture."""
        image = cv2.imdecode(np.frombuffer(self.jpeg, np.uint8), cv2.IMREAD_COLOR) if self.jpeg else None
        if image is None:
            raise FieldnavError(f"{_named(self.seen)}: is no JPEG")
        return image.astype(np.uint8, copy=False)


def pictured(seen: Seen, data: bytes) -> Picture:
    """The picture of a foxglove.CompressedImage. Raises FieldnavError for what is none."""
    try:
        return Picture(seen, jpeg_of(data))
    except DecodeError as error:
        raise FieldnavError(f"{_named(seen)}: is no compressed image") from error


def same(sequence: int, of_frame: int) -> bool:
    """Whether a message's number is that of a frame, of which it holds the last four bytes."""
    return sequence == of_frame & MOST_SEQUENCE


def _named(seen: Seen) -> str:
    return f"recorded frame {seen.sequence} of the {seen.camera.value} camera"
