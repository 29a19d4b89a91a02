"""How large a picture OpenCV may allocate, whatever size its head claims."""

import os

from fieldnav.settings.camera import LARGEST_SIDE_PX

LARGEST = "OPENCV_IO_MAX_IMAGE_PIXELS"
"""OpenCV reads this from the environment when it is loaded."""


def limit_pictures() -> None:
    """Allow no picture larger than a camera's; to be called before OpenCV is loaded."""
    os.environ.setdefault(LARGEST, str(LARGEST_SIDE_PX**2))
