"""Pictures of another size than the robot file's: scaled where they show the same, refused where not."""

import cv2
import numpy as np

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Image
from fieldnav.settings.camera import CameraSettings

OFF = 0.01
"""Of the aspect ratio; a pixel that video encoders take away at the edge is less."""


def fitted(image: Image, camera: CameraSettings, name: str) -> Image:
    """The picture in the size of the robot file, the same object where it has it. Raises DriverError."""
    height, width = image.shape[:2]
    wanted = (camera.width_px, camera.height_px)
    if (width, height) == wanted:
        return image
    if abs(width * camera.height_px / (height * camera.width_px) - 1) > OFF:
        raise DriverError(
            f"{name}: is {width}x{height} px; allowed is the {wanted[0]}x{wanted[1]} px of the robot file, "
            "or another size of the same shape",
            FaultKind.CAMERA_SIZE,
        )
    return np.asarray(cv2.resize(image, wanted, interpolation=cv2.INTER_AREA), np.uint8)
