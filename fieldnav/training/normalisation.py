"""What the network is given: images normalised each by its own brightness and contrast.

It needs numpy alone, so that the robot can do the same without PyTorch.
"""

import numpy as np
from numpy.typing import NDArray

WHITE = 255.0
MIN_CONTRAST = 0.05  # added to the deviation: noise of an even image is not blown up


def normalise(images: NDArray[np.uint8] | NDArray[np.float32]) -> NDArray[np.float32]:
    """Network inputs, shape (n, 3, h, w), of images, shape (n, h, w, 3), blue green red, 0 to 255."""
    values = images.astype(np.float32) / np.float32(WHITE)
    mean = values.mean(axis=(1, 2, 3), keepdims=True)
    deviation = values.std(axis=(1, 2, 3), keepdims=True)
    return np.ascontiguousarray(((values - mean) / (deviation + MIN_CONTRAST)).transpose(0, 3, 1, 2))
