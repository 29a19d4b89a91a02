"""The grown plants of a field: a few variants of each species, padded to one number of vertices."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.simulation.plants import PlantModel, grow
from fieldnav.simulation.sowing import VARIANTS
from fieldnav.simulation.streams import Stream, random_stream

GROWTH = (0.25, 1.0)  # of the variants, within the crop's stage


@dataclass(frozen=True, slots=True)
class Models:
    """variants[species][variant]; all their leaves have `vertices` vertices, the last repeated."""

    variants: tuple[tuple[PlantModel, ...], ...]
    vertices: int

    def palettes(self) -> list[NDArray[np.uint8]]:
        """One palette a species."""
        return [models[0].palette for models in self.variants]


def grow_models(species: tuple[str, ...], seed: int) -> Models:
    """Grow VARIANTS of each species; those of one species do not depend on which others there are."""
    grown = tuple(
        tuple(
            grow(name, float(np.linspace(*GROWTH, VARIANTS)[variant]), _generator(name, variant, seed))
            for variant in range(VARIANTS)
        )
        for name in species
    )
    vertices = max(model.leaves.shape[1] for models in grown for model in models)
    return Models(grown, vertices)


def _generator(name: str, variant: int, seed: int) -> np.random.Generator:
    return random_stream(seed, Stream.GROWTH, variant, *name.encode())


def padded(leaves: NDArray[np.float32], vertices: int) -> NDArray[np.float32]:
    """Outlines (n, v, 3) with their last vertex repeated up to `vertices`."""
    return np.pad(leaves, ((0, 0), (0, vertices - leaves.shape[1]), (0, 0)), mode="edge")
