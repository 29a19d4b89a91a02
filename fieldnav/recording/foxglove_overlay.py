"""What the robot saw and decided, drawn over its picture by Foxglove: foxglove.ImageAnnotations."""

from collections.abc import Iterable, Sequence
from datetime import datetime

import numpy as np
from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.Point2_pb2 import Point2
from foxglove_schemas_protobuf.PointsAnnotation_pb2 import PointsAnnotation
from foxglove_schemas_protobuf.TextAnnotation_pb2 import TextAnnotation

from fieldnav.journal.overlay import CENTRE, FEATURE, HELD_ROW, ROW, TEXT
from fieldnav.messages import Centres, Floats, RowLine
from fieldnav.recording.foxglove import timestamp

LINE_WIDTH = 1 / 426
FONT_HEIGHT = 0.022
MARGIN = 0.015
"""All over the image's width."""

DIMMED = 0.5
"""Opacity of rows that are kept from earlier frames."""

BEHIND_TEXT = Color(r=0, g=0, b=0, a=0.5)
BRIGHTEST = 255
PIXEL_CENTRE = 0.5
"""Foxglove counts from the corner of the first pixel, we from its centre."""


def overlay(
    utc: datetime,
    size_px: tuple[int, int],
    rows: Sequence[RowLine],
    centres: Centres | None = None,
    feature: RowLine | None = None,
    caption: Sequence[str] = (),
    sky_px: float = 0.0,
) -> bytes:
    """Rows, plants, the average line and lines of text over a picture of size_px, width and height.

    sky_px: how many image rows look above the horizon; no row is drawn there.
    """
    width, last = size_px[0], size_px[1] - 1.0
    thick = max(1.0, width * LINE_WIDTH)
    held = [row for row in rows if row.confidence <= 0]
    points = [
        _lines([row for row in rows if row.confidence > 0], (sky_px, last), _colour(ROW), thick),
        _lines(held, (sky_px, last), _colour(HELD_ROW, DIMMED), thick),
        _lines([feature] if feature else [], (sky_px, last), _colour(FEATURE), 2 * thick),
    ]
    if centres is not None and len(centres):
        points.append(_dots(centres.position_px, 4 * thick))
    drawn = ImageAnnotations(
        timestamp=timestamp(utc),
        points=[annotation for annotation in points if annotation.points],
        texts=_texts(caption, width),
    )
    return drawn.SerializeToString()


def _lines(
    rows: Iterable[RowLine], between_px: tuple[float, float], colour: Color, thick: float
) -> PointsAnnotation:
    """Between two image rows, the lower of which is the last."""
    upper, last = between_px
    ends = [(row.at(upper, last), upper, row.x_bottom_px, last) for row in rows]
    return PointsAnnotation(
        type=PointsAnnotation.LINE_LIST,
        points=_points(np.array(ends, dtype=float).reshape(-1, 2)),
        outline_color=colour,
        thickness=thick,
    )


def _dots(position_px: Floats, thick: float) -> PointsAnnotation:
    colour = _colour(CENTRE)
    return PointsAnnotation(
        type=PointsAnnotation.POINTS,
        points=_points(position_px),
        outline_color=colour,
        fill_color=colour,
        thickness=thick,
    )


def _points(position_px: Floats) -> list[Point2]:
    return [Point2(x=x, y=y) for x, y in (position_px + PIXEL_CENTRE).tolist()]


def _texts(caption: Sequence[str], width: int) -> list[TextAnnotation]:
    size, margin = width * FONT_HEIGHT, width * MARGIN
    return [
        TextAnnotation(
            position=Point2(x=margin, y=margin + (line + 1) * (size + margin / 2)),
            text=text,
            font_size=size,
            text_color=_colour(TEXT),
            background_color=BEHIND_TEXT,
        )
        for line, text in enumerate(caption)
    ]


def _colour(bgr: tuple[int, int, int], opacity: float = 1.0) -> Color:
    blue, green, red = (value / BRIGHTEST for value in bgr)
    return Color(r=red, g=green, b=blue, a=opacity)
