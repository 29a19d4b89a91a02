"""A drawn picture with its truth: what the network learns from instead of photographs."""

from dataclasses import dataclass

import numpy as np

from fieldnav.training.crop_field import draw_crop_field
from fieldnav.training.light import Image, expose
from fieldnav.training.rowless import draw_bare_field, draw_leaves, draw_scene, draw_uprights
from fieldnav.training.truth import Heat, Ignored, RowCourse, no_rows, truth_of_rows

ROWS_SHARE = 0.60
"""Share of the pictures that show a field of rows."""
ROWLESS = (draw_bare_field, draw_leaves, draw_uprights, draw_scene)
ROWLESS_SHARES = (0.25, 0.30, 0.20, 0.25)  # of the others


@dataclass(frozen=True, slots=True)
class DrawnPicture:
    """An image of shape (128, 192, 3), uint8, blue green red, with its truth at half that size.

    heat: shape (64, 96), uint8, 255 on the centres of the rows; ignored: (64, 96), bool, what is not judged;
    rows: the courses of all rows in pixels of the image, seen or hidden.
    """

    image: Image
    heat: Heat
    ignored: Ignored
    rows: tuple[RowCourse, ...] = ()


def draw(seed: int) -> DrawnPicture:
    """The picture of a seed: a field of rows or something else."""
    random = np.random.default_rng(seed)
    kind = random.random()
    if kind < ROWS_SHARE:
        field = draw_crop_field(random)
        truth = truth_of_rows(field.rows, field.hidden)
        return DrawnPicture(expose(random, field.canvas), *truth, tuple(field.rows))
    kind = (kind - ROWS_SHARE) / (1 - ROWS_SHARE)
    scene = ROWLESS[int(np.searchsorted(np.cumsum(ROWLESS_SHARES[:-1]), kind, side="right"))]
    return DrawnPicture(expose(random, scene(random)), *no_rows())
