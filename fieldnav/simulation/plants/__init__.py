"""Procedural plants: three-dimensional leaves of eight crops and the weeds among them."""

from fieldnav.simulation.plants.catalogue import CROP_SPECIES, WEED_SPECIES, grow
from fieldnav.simulation.plants.model import PlantModel

__all__ = ["CROP_SPECIES", "WEED_SPECIES", "PlantModel", "grow"]
