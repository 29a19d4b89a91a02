"""The grown plants of a field: a few variants of each species, their leaves laid out one after the other."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.simulation.plants import PlantModel, grow
from fieldnav.simulation.sowing import VARIANTS
from fieldnav.simulation.streams import Stream, random_stream

Reals = NDArray[np.float32]

GROWTH = (0.25, 1.0)  # of the variants, within the crop's stage


@dataclass(frozen=True, slots=True)
class Models:
    """Leaves of all variants of all species, those of one variant together, in the order of painting.

    outline: shape (n, v, 3), normalised as in PlantModel, short ones repeat their last vertex;
    normal: (n, 3); tone: (n,); centre: (n, 3), middle of the outline; across, rise: (n,), from there to the
    farthest vertex, horizontally and vertically; species: (n,); first, count: (species, variants), where a
    variant's leaves begin and how many they are; palettes: one a species.
    """

    outline: Reals
    normal: Reals
    tone: Reals
    centre: Reals
    across: Reals
    rise: Reals
    species: NDArray[np.intp]
    first: NDArray[np.intp]
    count: NDArray[np.intp]
    palettes: list[NDArray[np.uint8]]

    def leaves_of(
        self, species: NDArray[np.int32], variant: NDArray[np.int32]
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """For plants of a species and variant, (n,): their leaves one after the other, and whose each is."""
        count = self.count[species, variant]
        plant = np.repeat(np.arange(len(count)), count)
        begin = np.cumsum(count) - count
        return np.arange(len(plant)) - begin[plant] + self.first[species, variant][plant], plant


def grow_models(species: tuple[str, ...], seed: int) -> Models:
    """Grow VARIANTS of each species; those of one species do not depend on which others there are."""
    growth = np.linspace(*GROWTH, VARIANTS)
    grown = [[_grow(name, i, float(growth[i]), seed) for i in range(VARIANTS)] for name in species]
    plants = [model for variants in grown for model in variants]
    vertices = max(model.leaves.shape[1] for model in plants)
    outline = np.concatenate([_padded(model.leaves, vertices) for model in plants])
    centre = (outline.min(axis=1) + outline.max(axis=1)) / 2
    away = outline - centre[:, None]
    count = np.array([[len(model.leaves) for model in variants] for variants in grown])
    return Models(
        outline=outline,
        normal=np.concatenate([model.normals for model in plants]),
        tone=np.concatenate([model.tone for model in plants]),
        centre=centre,
        across=np.hypot(away[..., 0], away[..., 1]).max(axis=1),
        rise=np.abs(away[..., 2]).max(axis=1),
        species=np.repeat(np.arange(len(species)), count.sum(axis=1)),
        first=(np.cumsum(count) - count.ravel()).reshape(count.shape),
        count=count,
        palettes=[variants[0].palette for variants in grown],
    )


def _grow(name: str, variant: int, growth: float, seed: int) -> PlantModel:
    return grow(name, growth, random_stream(seed, Stream.GROWTH, variant, *name.encode()))


def _padded(leaves: Reals, vertices: int) -> Reals:
    """Outlines (n, v, 3) with their last vertex repeated up to `vertices`."""
    return np.pad(leaves, ((0, 0), (0, vertices - leaves.shape[1]), (0, 0)), mode="edge")
