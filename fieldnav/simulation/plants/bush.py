"""Bushes: opposite leaves, each pair square to the next, up one or several stems (lemon balm and weeds)."""

from math import pi, radians

import numpy as np

from fieldnav.simulation.plants.habit import STEM_FOOT, Habit, Trait, any_turn_rad, dark_heart, heights
from fieldnav.simulation.plants.leaf import Shape, Stance, whole
from fieldnav.simulation.plants.model import Foliage, PlantModel
from fieldnav.simulation.plants.palette import PALETTES

BALM_LEAF = Shape(
    stations=(0.0, 0.14, 0.36, 0.58, 0.82, 1.0),
    half_widths=(0.08, 0.28, 0.36, 0.30, 0.16, 0.02),
)
BALM = Habit(
    length=Trait(0.26, 0.2, 0.02),
    rise_rad=Trait.degrees(12, 35, 6),
    bend_rad=Trait.degrees(45, 45),
    tone=Trait(0.2, 0.65, 0.06),
    turn_rad=radians(8),
    roll_rad=radians(12),
)
BALM_STEMS = 4
BALM_STEM = Habit(
    length=Trait(0.64, 0.64, 0.03),
    rise_rad=Trait.degrees(50, 50, 6),
    bend_rad=Trait.degrees(-30, -30),
    tone=BALM.tone,
    turn_rad=radians(12),
)
BALM_STATIONS = (0.6, 1.0)
"""Nodes on an outer stem."""
BALM_MIDDLE = Stance(STEM_FOOT, azimuth_rad=0.0, rise_rad=radians(90), bend_rad=0.0, length=0.66)
BALM_MIDDLE_STATIONS = (0.6, 0.8, 1.0)
BALM_SERRATION = 0.07
"""Unevenness of the blade's edge."""
BALM_HEART = (0.26, 0.3)
"""Radius and height of the bush's dark inside."""
BALM_SMALLEST_SCALE = 0.9
"""Length of the outer stems when the stage begins; 1 at its end."""

CHICKWEED_LEAF = Shape(stations=(0.0, 0.25, 0.55, 0.82, 1.0), half_widths=(0.06, 0.30, 0.32, 0.17, 0.01))
CHICKWEED = Habit(
    length=Trait(0.34, 0.2, 0.02),
    rise_rad=Trait.degrees(10, 30, 6),
    bend_rad=Trait.degrees(20, 20),
    tone=Trait(0.25, 0.6, 0.06),
    turn_rad=radians(8),
    roll_rad=radians(12),
)
CHICKWEED_STEMS = 3
CHICKWEED_STEM = Habit(
    length=Trait(0.62, 0.62, 0.08),
    rise_rad=Trait.degrees(22, 22),
    bend_rad=Trait.degrees(5, 5),
    tone=CHICKWEED.tone,
    turn_rad=radians(20),
)
CHICKWEED_STATIONS = (0.5, 1.0)
CHICKWEED_SMALLEST_SCALE = 0.8

FAT_HEN_LEAF = Shape(
    stations=(0.0, 0.22, 0.42, 0.6, 0.8, 1.0),
    half_widths=(0.03, 0.09, 0.29, 0.21, 0.13, 0.01),
)
FAT_HEN = Habit(
    length=Trait(0.5, 0.22, 0.03),
    rise_rad=Trait.degrees(25, 55, 6),
    bend_rad=Trait.degrees(40, 40),
    tone=Trait(0.15, 0.8, 0.06),
    turn_rad=radians(8),
    roll_rad=radians(12),
)
FAT_HEN_STEM = Stance(STEM_FOOT, azimuth_rad=0.0, rise_rad=radians(90), bend_rad=0.0, length=1.0)
FAT_HEN_STATIONS = (0.35, 0.58, 0.8, 1.0, 1.05)
"""The last one is there late in the stage alone."""
BALM_HEIGHT = 0.9
"""Usual height in canopy diameters."""
CHICKWEED_HEIGHT = 0.3
FAT_HEN_HEIGHT = 0.9


def lemon_balm(growth: float, rng: np.random.Generator) -> PlantModel:
    """Several stems dense with ovate, toothed, wrinkled yellow-green leaves."""
    foliage = Foliage()
    turn_rad = any_turn_rad(rng)
    foliage.add([dark_heart(*BALM_HEART, rng)], [0.0], below=1.0)
    scale = BALM_SMALLEST_SCALE + (1 - BALM_SMALLEST_SCALE) * growth
    for i in range(BALM_STEMS):
        stem = BALM_STEM.stance(turn_rad + i * 2 * pi / BALM_STEMS, 0.0, rng, scale)
        _grow_pairs(foliage, stem, BALM_STATIONS, BALM_LEAF, BALM, rng, BALM_SERRATION)
    _grow_pairs(foliage, BALM_MIDDLE, BALM_MIDDLE_STATIONS, BALM_LEAF, BALM, rng, BALM_SERRATION)
    return foliage.finish(PALETTES["lemon-balm"], BALM_HEIGHT)


def chickweed(growth: float, rng: np.random.Generator) -> PlantModel:
    """A low mat of small ovate leaves on stems that creep outwards."""
    foliage = Foliage()
    turn_rad = any_turn_rad(rng)
    scale = CHICKWEED_SMALLEST_SCALE + (1 - CHICKWEED_SMALLEST_SCALE) * growth
    for i in range(CHICKWEED_STEMS):
        stem = CHICKWEED_STEM.stance(turn_rad + i * 2 * pi / CHICKWEED_STEMS, 0.0, rng, scale)
        _grow_pairs(foliage, stem, CHICKWEED_STATIONS, CHICKWEED_LEAF, CHICKWEED, rng)
    return foliage.finish(PALETTES["chickweed"], CHICKWEED_HEIGHT)


def fat_hen(growth: float, rng: np.random.Generator) -> PlantModel:
    """One upright stem of mealy, rhombic leaves, pale at the top."""
    foliage = Foliage()
    stations = FAT_HEN_STATIONS[: len(FAT_HEN_STATIONS) - 1 + round(growth)]
    _grow_pairs(foliage, FAT_HEN_STEM, stations, FAT_HEN_LEAF, FAT_HEN, rng)
    return foliage.finish(PALETTES["fat-hen"], FAT_HEN_HEIGHT)


def _grow_pairs(
    foliage: Foliage,
    stem: Stance,
    stations: tuple[float, ...],
    shape: Shape,
    habit: Habit,
    rng: np.random.Generator,
    serration: float = 0.0,
) -> None:
    """Add a pair of leaves at each station of the stem, each pair square to the one below."""
    azimuth_rad = any_turn_rad(rng)
    for station, height in zip(stations, heights(len(stations)), strict=True):
        for side in (0, 1):
            teeth = 1 + serration * rng.standard_normal(len(shape.stations))
            stance = habit.stance_from(stem.point(station), azimuth_rad + side * pi, height, rng)
            foliage.add([whole(stance, shape, teeth)], [habit.tone.at(height, rng)])
        azimuth_rad += pi / 2
