"""JPEGs decoded whole or not at all: a decoder makes something of every damage, and only warns of it."""

from collections.abc import Iterator

import numpy as np
import simplejpeg

from fieldnav.errors import PictureError
from fieldnav.messages import Image
from fieldnav.settings.camera import LARGEST_SIDE_PX

BEGIN, END, START_OF_SCAN = b"\xff\xd8", b"\xff\xd9", b"\xff\xda"
SCAN, TABLES, PROGRESSIVE = 0xDA, 0xC4, 0xC2
"""Markers of a JPEG's segments, ISO/IEC 10918-1, table B.1."""
CODE_LENGTHS = 16
COEFFICIENTS, END_OF_BLOCK = 1, 0
"""The class of a code table, and its symbol for: all further coefficients of this block are zero."""
HOLE = bytes(64)
"""As zeros, at least two blocks whose every coefficient is -1, which no camera gives. A lost USB packet."""


def decoded_jpeg(jpeg: bytes) -> Image:
    """The picture, shape (height, width, 3), blue green red, not turned as its EXIF says.

    Raises PictureError for no JPEG, for one that is too large and for one that is damaged.
    """
    try:
        height, width, *_ = simplejpeg.decode_jpeg_header(jpeg)
    except ValueError as error:
        raise PictureError from error
    if max(height, width) > LARGEST_SIDE_PX:
        raise PictureError
    try:
        image = simplejpeg.decode_jpeg(jpeg, "BGR", strict=True)
    except ValueError as error:
        raise PictureError(damaged=True) from error
    if _has_hole(jpeg):
        raise PictureError(damaged=True)
    return np.asarray(image, dtype=np.uint8)


def _has_hole(jpeg: bytes) -> bool:
    """Whether zeros stand where pixels were and happen to decode, with as many blocks, as they do at times.

    An optimised code may begin with the end of a block, so that a flat area is all zeros; that is no hole.
    """
    if HOLE not in jpeg:
        return False
    segments = list(_segments(jpeg))
    if any(marker == PROGRESSIVE for marker, _, _ in segments):
        return False
    tables = [content for marker, _, content in segments if marker == TABLES]
    first_symbols = {symbol for each in tables for symbol in _first_symbols(each)}
    _, at, _ = segments[-1]
    end = jpeg.find(END, at)
    several_scans = jpeg.find(START_OF_SCAN, at, end) >= 0
    return not several_scans and first_symbols != {END_OF_BLOCK} and jpeg.find(HOLE, at, end) >= 0


def _segments(jpeg: bytes) -> Iterator[tuple[int, int, bytes]]:
    """Marker, end and content of each segment, as far as the first scan's header."""
    at, marker = len(BEGIN), 0
    while marker != SCAN and jpeg[at : at + 1] == BEGIN[:1]:
        marker, length = jpeg[at + 1], int.from_bytes(jpeg[at + 2 : at + 4], "big")
        content, at = jpeg[at + 4 : at + 2 + length], at + 2 + length
        yield marker, at, content


def _first_symbols(tables: bytes) -> Iterator[int]:
    """Of each code for coefficients the symbol whose code is all zeros."""
    while len(tables) > CODE_LENGTHS + 1:
        symbols = sum(tables[1 : CODE_LENGTHS + 1])
        if tables[0] >> 4 == COEFFICIENTS:
            yield tables[CODE_LENGTHS + 1]
        tables = tables[CODE_LENGTHS + 1 + symbols :]
