"""Whorls: narrow leaves like the spokes of a wheel, up a weak stem (cleavers)."""

from math import pi, radians

import numpy as np

from fieldnav.simulation.plants.habit import Habit, Trait, any_turn_rad
from fieldnav.simulation.plants.leaf import Shape, whole
from fieldnav.simulation.plants.model import Foliage, PlantModel
from fieldnav.simulation.plants.palette import PALETTES

SPOKE = Shape(stations=(0.0, 0.4, 0.75, 0.92, 1.0), half_widths=(0.03, 0.10, 0.14, 0.10, 0.01))
STEM = Habit(
    length=Trait(0.8, 0.8),
    rise_rad=Trait.degrees(78, 78, 4),
    bend_rad=Trait.degrees(-5, -5),
    tone=Trait(0.5, 0.5),
)
LEAVES = Habit(
    length=Trait(0.55, 0.4, 0.03),
    rise_rad=Trait.degrees(5, 30, 6),
    bend_rad=Trait.degrees(20, 20),
    tone=Trait(0.3, 0.6, 0.06),
    turn_rad=radians(6),
)
NODES = ((0.4, 0.0), (1.0, 1.0))
"""Place on the stem and relative height of the two whorls."""
FEWEST_SPOKES = 5
HEIGHT = 0.4
"""Usual height in canopy diameters."""


def cleavers(growth: float, rng: np.random.Generator) -> PlantModel:
    """Two whorls of five or six narrow leaves, the upper one smaller and lighter."""
    foliage = Foliage()
    stem = STEM.stance(any_turn_rad(rng), 0.0, rng)
    n_spokes = FEWEST_SPOKES + round(growth)
    for station, height in NODES:
        turn_rad = any_turn_rad(rng)
        for spoke in range(n_spokes):
            azimuth_rad = turn_rad + spoke * 2 * pi / n_spokes
            stance = LEAVES.stance_from(stem.point(station), azimuth_rad, height, rng)
            foliage.add([whole(stance, SPOKE)], [LEAVES.tone.at(height, rng)])
    return foliage.finish(PALETTES["cleavers"], HEIGHT)
