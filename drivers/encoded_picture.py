"""Pictures as files hold them, decoded whole or not at all, and without a word of the decoders' own."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

import cv2
import numpy as np

from drivers.jpeg import BEGIN, decoded_jpeg
from fieldnav.errors import PictureError
from fieldnav.messages import Image
from fieldnav.settings.shown_source import in_unicode

STANDARD_ERROR = 2
SAID_OF_DAMAGE = b"error"
"""In every line that libpng and libtiff write of damage, and in none of their warnings of odd headers."""


def decoded_picture(content: bytes) -> Image:
    """The first picture in a file's content, shape (height, width, 3), blue green red, turned as EXIF says.

    Raises PictureError for what is no picture and for what is damaged, as far as the format lets one tell:
    BMP, WebP and TIFF that is not compressed by LZW have no check, so that only their length tells.
    """
    if content.startswith(BEGIN):
        decoded_jpeg(content)  # OpenCV passes over its decoder's warnings
    with _overheard() as said:
        try:
            image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR) if content else None
        except cv2.error:  # a head that claims more pixels than OpenCV allocates
            image = None
    if image is None:
        raise PictureError
    if SAID_OF_DAMAGE in b"".join(said).lower():
        raise PictureError(damaged=True)
    return np.asarray(image, dtype=np.uint8)


def further_pictures(path: str) -> int:
    """How many pictures a file holds behind the first, as animations do; 0 where nobody can tell."""
    if not in_unicode(path):
        return 0
    with _overheard():
        try:
            return max(cv2.imcount(path) - 1, 0)
        except cv2.error:
            return 0


@contextmanager
def _overheard() -> Iterator[list[bytes]]:
    """What decoders write to standard error meanwhile, instead of its being written there.

    libpng and libtiff tell of damage nowhere else, and what they have decoded is given out as a picture.
    """
    said: list[bytes] = []
    level = cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_ERROR)
    kept = os.dup(STANDARD_ERROR)
    try:
        with tempfile.TemporaryFile() as file:
            os.dup2(file.fileno(), STANDARD_ERROR)
            try:
                yield said
            finally:
                os.dup2(kept, STANDARD_ERROR)
                file.seek(0)
                said.append(file.read())
    finally:
        os.close(kept)
        cv2.utils.logging.setLogLevel(level)
