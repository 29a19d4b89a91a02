"""What the ground's textures have in common: their scale, their steps of brightness, and noise that repeats.

Values are steps of the soil's colour ramp (see rendering/palette). Columns run along -y, rows along -x.
"""

import cv2
import numpy as np
from numpy.typing import NDArray

Texture = NDArray[np.uint8]
Reals = NDArray[np.float32]

PIXEL_M = 0.00125  # about what a pixel of the robot's cameras sees
SOIL_STEPS = 92  # of the colour ramp
SOIL_MEAN = 36.0  # the step that has the soil's own colour
BRIGHTEST_STEP = SOIL_STEPS - 6  # leaves room for the mottle that the renderer adds
BARE = 0  # in the litter texture: nothing lies here
CUBIC_GAIN = np.float32(1.3)  # cubic interpolation of white noise loses about this much of its deviation


def repeating_noise(random: np.random.Generator, pixels: int, cells: int) -> Reals:
    """Smooth noise of unit variance over a square that repeats seamlessly, shape (pixels, pixels)."""
    margin = 2
    grid = random.standard_normal((cells, cells)).astype(np.float32)
    grid = np.pad(grid, margin, mode="wrap")
    scale = pixels // cells
    large = cv2.resize(grid, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC)
    inner = large[margin * scale : margin * scale + pixels, margin * scale : margin * scale + pixels]
    return np.asarray(inner / grid.std(), dtype=np.float32) * CUBIC_GAIN
