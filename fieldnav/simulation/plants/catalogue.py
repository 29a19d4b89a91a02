"""The species there are, and one call that grows any of them."""

from collections.abc import Callable
from types import MappingProxyType

import numpy as np

from fieldnav.simulation.plants.bush import chickweed, fat_hen, lemon_balm
from fieldnav.simulation.plants.feathery import coriander
from fieldnav.simulation.plants.maize import maize
from fieldnav.simulation.plants.model import PlantModel
from fieldnav.simulation.plants.pinnate import potato
from fieldnav.simulation.plants.rosette import shepherds_purse, sugar_beet
from fieldnav.simulation.plants.trifoliate import beans, soybean
from fieldnav.simulation.plants.tuft import meadow_grass, winter_wheat
from fieldnav.simulation.plants.whorl import cleavers

Grower = Callable[[float, np.random.Generator], PlantModel]

_CROPS: dict[str, Grower] = {
    "sugar-beet": sugar_beet,
    "coriander": coriander,
    "potato": potato,
    "beans": beans,
    "lemon-balm": lemon_balm,
    "maize": maize,
    "soybean": soybean,
    "winter-wheat": winter_wheat,
}
_WEEDS: dict[str, Grower] = {
    "shepherds-purse": shepherds_purse,
    "chickweed": chickweed,
    "meadow-grass": meadow_grass,
    "fat-hen": fat_hen,
    "cleavers": cleavers,
}
_GROWERS = MappingProxyType(_CROPS | _WEEDS)

CROP_SPECIES: tuple[str, ...] = tuple(_CROPS)
WEED_SPECIES: tuple[str, ...] = tuple(_WEEDS)


def grow(species: str, growth: float, rng: np.random.Generator) -> PlantModel:
    """One variant of a species; equal generators give equal plants.

    `growth` is the progress within the stage, clipped to 0..1.

    Raises KeyError for a species that is neither in CROP_SPECIES nor in WEED_SPECIES.
    """
    return _GROWERS[species](min(max(growth, 0.0), 1.0), rng)
