"""Whether the network bears out the rows that vegetation shows: a second opinion on every fresh look."""

import cv2
import numpy as np

from fieldnav.messages import Image, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.comb.row_contrast import HEIGHTS, NARROWEST, WIDEST, PlacedRows, contrast_of
from fieldnav.perception.row_network import FULL, look
from fieldnav.perception.vegetation import as_colour
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

BLUR = (3, 1)  # of the network's cells: a row that lies half a cell beside is one still
BORNE_OUT = 0.45
"""Contrast of one row at least. In ordinary photographs what vegetation takes for rows has 0.3 at most, in
rendered fields rows have 0.75 to 0.95."""


def contrast_in_network(
    image: Image, lines: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole
) -> float:
    """How far the best of these rows stands out of what the network sees, -1 to 1; -1 without any.

    image: shape (h, w, 3), uint8, blue green red, of a camera whose pose is known.
    """
    colour = as_colour(image)
    if colour is None or not lines:
        return -1.0
    top = int(camera.top_px)
    ground = np.ascontiguousarray(colour[top:])
    height, width = ground.shape[:2]
    warm = np.asarray(cv2.blur(look(ground).centres.astype(np.float32) / FULL, BLUR), np.float32)
    y_px = top + HEIGHTS * height
    place = np.array([[line.at(float(y), camera.height_px - 1.0) for y in y_px] for line in lines]) / width
    per_metre = canopy_plane(camera, crop).pixels_per_metre(y_px)
    spacing = (crop.rows.spacing_m * np.asarray(per_metre) / width).clip(NARROWEST, WIDEST)
    rows = PlacedRows(place, spacing)
    return float(contrast_of(rows, warm).contrast[rows.seen].max(initial=-1.0))
