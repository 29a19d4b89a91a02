"""Rosettes: leaves in a spiral about one point of the ground (sugar beet, shepherd's purse)."""

from math import radians

import numpy as np

from fieldnav.simulation.plants.habit import GOLDEN_ANGLE_RAD, Habit, Trait, any_turn_rad, heights
from fieldnav.simulation.plants.leaf import Shape, halves, stalk, whole
from fieldnav.simulation.plants.model import Foliage, PlantModel
from fieldnav.simulation.plants.palette import PALETTES

BEET_LEAVES = 5
BEET_BLADE = Shape(
    stations=(0.38, 0.42, 0.52, 0.66, 0.80, 0.92, 1.0),
    half_widths=(0.02, 0.13, 0.21, 0.225, 0.185, 0.12, 0.02),
)
BEET = Habit(
    length=Trait(1.0, 0.84, 0.05),
    rise_rad=Trait.degrees(38, 56, 5),
    bend_rad=Trait.degrees(66, 66, 9),
    tone=Trait(0.22, 0.36, 0.04),
    turn_rad=radians(8),
    roll_rad=radians(12),
)
BEET_WAVINESS = 0.09
"""Standard deviation of the blade's width along it."""
BEET_FOLD_RAD = radians(15)
BEET_HALVES_TONE_STEP = 0.06
"""One half of a glossy blade looks lighter than the other."""
BEET_PETIOLE_REACH = (0.0, 0.42)
BEET_PETIOLE_WIDTHS = (0.055, 0.035)
BEET_PETIOLE_TONE = 0.75
BEET_MIDRIB_REACH = (0.42, 0.9)
BEET_MIDRIB_WIDTHS = (0.032, 0.008)
BEET_MIDRIB_TONE = 0.85

YOUNG_BEET_LEAVES = 3
YOUNG_BEET_BLADE = Shape(stations=(0.2, 0.4, 0.6, 0.8, 1.0), half_widths=(0.02, 0.15, 0.18, 0.13, 0.01))
YOUNG_BEET = Habit(
    length=Trait(0.56, 0.4, 0.04),
    rise_rad=Trait.degrees(72, 82, 4),
    bend_rad=Trait.degrees(60, 60),
    tone=Trait(0.45, 0.62),
    base_height=Trait(0.05, 0.05),
    roll_rad=radians(15),
)

PURSE_LEAVES = 7
PURSE_BLADE = Shape(
    stations=(0.0, 0.35, 0.5, 0.62, 0.78, 1.0),
    half_widths=(0.025, 0.055, 0.09, 0.085, 0.12, 0.02),
)
PURSE = Habit(
    length=Trait(1.0, 0.5, 0.07),
    rise_rad=Trait.degrees(15, 38),
    bend_rad=Trait.degrees(40, 40),
    tone=Trait(0.3, 0.62, 0.05),
    base_height=Trait(0.02, 0.02),
    turn_rad=radians(6),
    roll_rad=radians(8),
)
BEET_HEIGHT = 0.6
"""Usual height in canopy diameters."""
PURSE_HEIGHT = 0.25


def sugar_beet(growth: float, rng: np.random.Generator) -> PlantModel:
    """Eight or nine leaves: broad, wavy, glossy, with a pale midrib, on stout petioles; young ones inside."""
    foliage = Foliage()
    azimuth_rad = any_turn_rad(rng)
    for height in heights(BEET_LEAVES):
        stance = BEET.stance(azimuth_rad, height, rng)
        wave = 1 + BEET_WAVINESS * rng.standard_normal(len(BEET_BLADE.stations))
        left, right = halves(stance, BEET_BLADE, BEET_FOLD_RAD, wave)
        petiole = stalk(stance, BEET_PETIOLE_REACH, BEET_PETIOLE_WIDTHS)
        midrib = stalk(stance, BEET_MIDRIB_REACH, BEET_MIDRIB_WIDTHS)
        tone = BEET.tone.at(height, rng)
        tones = [tone, tone + BEET_HALVES_TONE_STEP, BEET_PETIOLE_TONE, BEET_MIDRIB_TONE]
        foliage.add([left, right, petiole, midrib], tones)
        azimuth_rad += GOLDEN_ANGLE_RAD
    for height in heights(YOUNG_BEET_LEAVES + round(growth)):
        stance = YOUNG_BEET.stance(azimuth_rad, height, rng)
        foliage.add([whole(stance, YOUNG_BEET_BLADE)], [YOUNG_BEET.tone.at(height, rng)])
        azimuth_rad += GOLDEN_ANGLE_RAD
    return foliage.finish(PALETTES["sugar-beet"], BEET_HEIGHT)


def shepherds_purse(growth: float, rng: np.random.Generator) -> PlantModel:
    """A flat star of seven to ten narrow, notched leaves, broadest towards the tip."""
    foliage = Foliage()
    azimuth_rad = any_turn_rad(rng)
    for height in heights(PURSE_LEAVES + round(3 * growth)):
        stance = PURSE.stance(azimuth_rad, height, rng)
        foliage.add([whole(stance, PURSE_BLADE)], [PURSE.tone.at(height, rng)])
        azimuth_rad += GOLDEN_ANGLE_RAD
    return foliage.finish(PALETTES["shepherds-purse"], PURSE_HEIGHT)
