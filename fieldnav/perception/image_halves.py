"""The far and the near half of an image (paper III-A.3: where row ends are judged)."""

from enum import Enum

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Centres
from fieldnav.pinhole import Pinhole


class ImagePart(Enum):
    """A part of the image: the far half, the near half, or all of it."""

    TOP = "top"
    BOTTOM = "bottom"
    WHOLE = "whole"


def lies_in(centres: Centres, camera: Pinhole, part: ImagePart) -> NDArray[np.bool_]:
    """Which plants have their centre in that part of the image; shape (n,)."""
    if part is ImagePart.WHOLE:
        return np.ones(len(centres), dtype=bool)
    return np.asarray((centres.position_px[:, 1] < camera.centre_y_px) == (part is ImagePart.TOP))
