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


@dataclass(frozen=True, slots=True)
class RowHeat:
    """What the network sees in a picture.

    centres: how likely the middle of a row runs through each cell, shape (64, 96), uint8, 255 standing for 1:
    so coarse that the last bits of a processor's arithmetic do not show; field: the probability that the
    picture shows a field of rows.
    """

    centres: NDArray[np.uint8]
    field: float


def look(image: Image) -> RowHeat:
    """What the network sees; image: shape (h, w, 3), uint8, blue green red.

    It looks at the picture and at its mirror image, and what it sees is the mean: a mirrored picture has the
    mirrored rows.
    """
    plain = network_input(image)
    centres, field = _forward(plain)
    mirrored, mirrored_field = _forward(np.ascontiguousarray(plain[..., ::-1]))
    return RowHeat(_levels((centres + mirrored[:, ::-1]) / 2), (field + mirrored_field) / 2)


def network_input(image: Image) -> NDArray[np.float32]:
    """The picture as the network takes it, shape (1, 3, 128, 192): small, and of standard light."""
    small = cv2.resize(image, SIZE_PX, interpolation=cv2.INTER_AREA).astype(np.float32) / FULL
    standard = (small - small.mean()) / (small.std() + LEAST_CONTRAST)
    return np.ascontiguousarray(standard.transpose(2, 0, 1)[None], np.float32)


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
