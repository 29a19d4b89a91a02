"""Leaflets in pairs along a rachis, with one at its end: potato."""

from dataclasses import replace
from math import radians

import numpy as np

from fieldnav.simulation.plants.habit import (
    GOLDEN_ANGLE_RAD,
    Habit,
    Trait,
    any_turn_rad,
    dark_heart,
    heights,
)
from fieldnav.simulation.plants.leaf import Shape, Stance, leaflet, whole
from fieldnav.simulation.plants.model import Foliage, PlantModel
from fieldnav.simulation.plants.palette import PALETTES

POINTED_OVAL = Shape(
    stations=(0.0, 0.1, 0.32, 0.58, 0.84, 1.0),
    half_widths=(0.05, 0.22, 0.33, 0.29, 0.12, 0.01),
)
LEAVES = 5
RACHIS = Habit(
    length=Trait(0.66, 0.5, 0.04),
    rise_rad=Trait.degrees(40, 58, 6),
    bend_rad=Trait.degrees(60, 60),
    tone=Trait(0.25, 0.5, 0.06),
    base_height=Trait(0.12, 0.32),
    turn_rad=radians(10),
)
YOUNGEST_RISE_RAD = radians(78)
SMALLEST_SCALE = 0.9
"""Length of the rachises when the stage begins; 1 at its end."""
PAIRS = ((0.45, 0.33), (0.75, 0.38))
"""Place on the rachis and length of each pair of lateral leaflets."""
PAIR_SPREAD_RAD = radians(74)
LEAFLET_SIZES = (0.9, 1.1)
END_STATION = 0.95
END_LENGTH = 0.46
END_WIDENING = 1.15
"""The leaflet at the end is the longest and the broadest."""
END_TONE_STEP = 0.06
HEART_RADIUS = 0.45
HEART_HEIGHT = 0.28
HEIGHT = 0.8
"""Usual height in canopy diameters."""


def potato(growth: float, rng: np.random.Generator) -> PlantModel:
    """A bushy mound of pinnate leaves with oval leaflets, the youngest leaf upright in the middle."""
    foliage = Foliage()
    azimuth_rad = any_turn_rad(rng)
    foliage.add([dark_heart(HEART_RADIUS, HEART_HEIGHT, rng)], [0.0], below=1.0)
    scale = SMALLEST_SCALE + (1 - SMALLEST_SCALE) * growth
    for i, height in enumerate(heights(LEAVES)):
        rachis = RACHIS.stance(azimuth_rad, height, rng, scale)
        youngest = i == LEAVES - 1
        if youngest:
            rachis = replace(rachis, rise_rad=YOUNGEST_RISE_RAD)
        _grow_leaflets(foliage, rachis, PAIRS[1:] if youngest else PAIRS, height, rng)
        azimuth_rad += GOLDEN_ANGLE_RAD
    return foliage.finish(PALETTES["potato"], HEIGHT)


def _grow_leaflets(
    foliage: Foliage,
    rachis: Stance,
    pairs: tuple[tuple[float, float], ...],
    height: float,
    rng: np.random.Generator,
) -> None:
    """Add the pairs of leaflets along a rachis and the large one at its end."""
    for station, length in pairs:
        for side in (1, -1):
            size = length * rng.uniform(*LEAFLET_SIZES)
            lateral = leaflet(rachis, station, side * PAIR_SPREAD_RAD, size, rng)
            foliage.add([whole(lateral, POINTED_OVAL)], [RACHIS.tone.at(height, rng)])
    end = leaflet(rachis, END_STATION, 0.0, END_LENGTH * rng.uniform(*LEAFLET_SIZES), rng)
    foliage.add([whole(end, POINTED_OVAL, END_WIDENING)], [RACHIS.tone.at(height, rng) + END_TONE_STEP])
