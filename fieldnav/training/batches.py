"""Batches of drawn pictures for training: picked at random, mirrored, and changed in colour and noise."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.perception.row_network import FULL, normalised
from fieldnav.training.pool import Chunk

BATCH = 32
MIRRORED_SHARE = 0.5  # of the pictures
TINTED_SHARE, TINT = 0.3, 0.12  # of the batches; deviation of each picture's and channel's gain
NOISY_SHARE, NOISE = 0.3, 0.1  # of the batches; in the network's input, whose deviation is about 1

Reals = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class TrainingBatch:
    """Network inputs with their truth, all float32.

    inputs: shape (n, 3, 128, 192); heat: (n, 1, 64, 96), 0 to 1; judged: (n, 1, 64, 96), 0 or 1.
    """

    inputs: Reals
    heat: Reals
    judged: Reals


class TrainingPictures:
    """The chunks that are trained on; more may be added at any time."""

    def __init__(self, random: np.random.Generator) -> None:
        self._random = random
        self._chunks: dict[int, Chunk] = {}

    def __len__(self) -> int:
        return sum(len(chunk) for chunk in self._chunks.values())

    def __contains__(self, number: int) -> bool:
        return number in self._chunks

    def add(self, number: int, chunk: Chunk) -> None:
        """Take in a chunk, all of the same size."""
        self._chunks[number] = chunk

    def next_batch(self) -> TrainingBatch:
        """BATCH pictures, each from anywhere."""
        random, chunks = self._random, list(self._chunks.values())
        places = [divmod(int(place), len(chunks[0])) for place in random.integers(0, len(self), BATCH)]
        images = np.stack([chunks[chunk].images[index] for chunk, index in places])
        heat = np.stack([chunks[chunk].heat[index] for chunk, index in places])
        ignored = np.stack([chunks[chunk].ignored[index] for chunk, index in places])
        mirrored = random.random(BATCH) < MIRRORED_SHARE
        for array in (images, heat, ignored):
            array[mirrored] = array[mirrored, :, ::-1]
        inputs = normalised(self._tinted(images))
        if random.random() < NOISY_SHARE:
            inputs += np.float32(NOISE) * random.standard_normal(inputs.shape, dtype=np.float32)
        return _batch(inputs, heat, ignored)

    def _tinted(self, images: NDArray[np.uint8]) -> NDArray[np.uint8] | Reals:
        if self._random.random() >= TINTED_SHARE:
            return images
        gains = 1 + TINT * self._random.standard_normal((len(images), 1, 1, 3), dtype=np.float32)
        return np.asarray((images * gains).clip(0, FULL), np.float32)


def plain_batches(chunk: Chunk) -> Iterator[TrainingBatch]:
    """All pictures of a chunk in order, unchanged."""
    for start in range(0, len(chunk), BATCH):
        part = slice(start, start + BATCH)
        yield _batch(normalised(chunk.images[part]), chunk.heat[part], chunk.ignored[part])


def _batch(inputs: Reals, heat: NDArray[np.uint8], ignored: NDArray[np.bool_]) -> TrainingBatch:
    return TrainingBatch(
        inputs, heat[:, None].astype(np.float32) / np.float32(FULL), 1 - ignored[:, None].astype(np.float32)
    )
