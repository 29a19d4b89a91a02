"""Whether the network bears out the rows that vegetation shows: a second opinion on every fresh look."""

import numpy as np

from fieldnav.messages import Image, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.comb.row_contrast import HEIGHTS, NARROWEST, WIDEST, PlacedRows, contrast_of
from fieldnav.perception.row_network import look
from fieldnav.perception.vegetation import as_colour
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

NO_FIELD = "no field in view: vegetation shows rows, and the network sees none there"
BORNE_OUT = 0.5
"""Share of one row at least. Of what vegetation takes for rows in ordinary photographs the network bears out
a third at most (in one of a hundred all), of rows in photographs of fields half at least."""


def share_borne_out(image: Image, lines: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole) -> float:
    """Over which share of its length the best of these rows stands out of what the network sees, 0 to 1.

    image: shape (h, w, 3), uint8, blue green red, of a camera whose pose is known.
    """
    colour = as_colour(image)
    if colour is None or not lines:
        return 0.0
    top = int(camera.top_px)
    ground = np.ascontiguousarray(colour[top:])
    height, width = ground.shape[:2]
    y_px = top + HEIGHTS * height
    place = np.array([[line.at(float(y), camera.height_px - 1.0) for y in y_px] for line in lines]) / width
    per_metre = canopy_plane(camera, crop).pixels_per_metre(y_px)
    spacing = (crop.rows.spacing_m * np.asarray(per_metre) / width).clip(NARROWEST, WIDEST)
    rows = PlacedRows(place, spacing)
    return float(contrast_of(rows, look(ground).spread).evenness[rows.seen].max(initial=0.0))


def by_vegetation_alone(crop: CropProfile) -> CropProfile:
    """The same profile without the second witness."""
    finding = crop.finding.model_copy(update={"second_witness": False})
    return crop.model_copy(update={"finding": finding})
