"""A second witness of rows: a small network that looks at the whole picture.

It has 0.09 million parameters and was trained on drawn pictures alone (`fieldnav.training`), never on a
photograph. OpenCV runs it.
"""

from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats, Image

SIZE_PX = (192, 128)
"""Width and height of the picture as the network sees it."""
LEAST_CONTRAST = 0.05
"""Added to the standard deviation that a picture is divided by; brightness goes from 0 to 1."""
FULL = 255
SPREAD = (3, 1)
"""Cells across and down."""


@dataclass(frozen=True, slots=True)
class RowHeat:
    """What the network sees in a picture.

    centres: how likely the middle of a row runs through each cell, shape (64, 96), uint8, 255 standing for 1:
    so coarse that the last bits of a processor's arithmetic do not show; field: the probability that the
    picture shows a field of rows.
    """

    centres: NDArray[np.uint8]
    field: float

    @property
    def spread(self) -> NDArray[np.float32]:
        """The same from 0 to 1, spread over neighbouring cells: a row half a cell beside is one still."""
        return np.asarray(cv2.blur(self.centres.astype(np.float32) / FULL, SPREAD), np.float32)


def look(image: Image) -> RowHeat:
    """What the network sees; image: shape (h, w, 3), uint8, blue green red.

    It looks at the picture and at its mirror image, and what it sees is the mean: a mirrored picture has the
    mirrored rows.
    """
    small = np.asarray(cv2.resize(image, SIZE_PX, interpolation=cv2.INTER_AREA), np.uint8)
    plain = normalised(small[None])
    centres, field = _forward(plain)
    mirrored, mirrored_field = _forward(np.ascontiguousarray(plain[..., ::-1]))
    return RowHeat(_levels((centres + mirrored[:, ::-1]) / 2), (field + mirrored_field) / 2)


def normalised(images: NDArray[np.uint8] | NDArray[np.float32]) -> NDArray[np.float32]:
    """Images of shape (n, h, w, 3), blue green red, 0 to 255, as the network takes them: (n, 3, h, w).

    Each is given by its own brightness and contrast.
    """
    values = images.astype(np.float32) / np.float32(FULL)
    mean = values.mean(axis=(1, 2, 3), keepdims=True)
    deviation = values.std(axis=(1, 2, 3), keepdims=True)
    return np.ascontiguousarray(((values - mean) / (deviation + LEAST_CONTRAST)).transpose(0, 3, 1, 2))


@lru_cache(maxsize=1)
def _network() -> cv2.dnn.Net:
    content = files(__package__).joinpath("row_network.onnx").read_bytes()
    return cv2.dnn.readNetFromONNX(np.frombuffer(content, np.uint8))


def _forward(inputs: NDArray[np.float32]) -> tuple[Floats, float]:
    """The probabilities of a row's middle, shape (64, 96), and of a field."""
    network = _network()
    network.setInput(inputs, "picture")
    centres, field = network.forward(["heat", "field"])
    return _probability(centres[0, 0]), float(_probability(field[0, 0]))


def _levels(probability: Floats) -> NDArray[np.uint8]:
    return np.asarray(np.rint(probability * FULL), np.uint8)


def _probability(logit: Floats | NDArray[np.float32]) -> Floats:
    return np.asarray(1 / (1 + np.exp(-np.asarray(logit, np.float64))))
