"""Maize: long strap leaves in two ranks, cut across into pieces that follow their bend."""

from math import pi, radians

import numpy as np

from fieldnav.simulation.plants.habit import STEM_FOOT, Habit, Trait, any_turn_rad, heights
from fieldnav.simulation.plants.leaf import Shape, Stance, pieces, stalk
from fieldnav.simulation.plants.model import Foliage, PlantModel
from fieldnav.simulation.plants.palette import PALETTES, RIB_TONE

BLADE = Shape(
    stations=(0.0, 0.15, 0.35, 0.5, 0.65, 0.8, 0.92, 1.0),
    half_widths=(0.032, 0.048, 0.056, 0.057, 0.052, 0.038, 0.019, 0.003),
)
CUTS = (0, 3, 5, 7)
MIDRIB = Shape(stations=(0.0, 0.5, 0.8), half_widths=(0.011, 0.007, 0.003))
MIDRIB_CUTS = (0, 1, 2)
LENGTHS = (0.7, 0.92, 1.05, 1.0, 0.8)
"""Of the leaves from the oldest up; those in the middle are the longest."""
HABIT = Habit(
    length=Trait(1.0, 1.0, 0.05),
    rise_rad=Trait.degrees(52, 78, 4),
    bend_rad=Trait.degrees(112, 90, 10),
    tone=Trait(0.25, 0.45, 0.04),
    base_height=Trait(0.06, 0.26),
    turn_rad=radians(14),
    roll_rad=radians(14),
)
TIPWARD_TONES = (0.0, 0.04, 0.08)
"""A blade grows lighter from piece to piece."""
MIDRIB_TONES = (RIB_TONE, 0.9)
RIBLESS_LEAVES = 2
"""Lowest leaves, whose midribs the others hide."""
SMALLEST_SCALE = 0.9
"""Length of the leaves when the stage begins; 1 at its end."""
STEM = Stance(STEM_FOOT, azimuth_rad=0.0, rise_rad=radians(88), bend_rad=0.0, length=0.32)
STEM_WIDTHS = (0.07, 0.05)
STEM_TONE = 0.6
HEIGHT = 1.05
"""Usual height in canopy diameters."""


def maize(growth: float, rng: np.random.Generator) -> PlantModel:
    """Five strap leaves in two ranks from one stem, arching over and hanging at the tip."""
    foliage = Foliage()
    azimuth_rad = any_turn_rad(rng)
    foliage.add([stalk(STEM, (0.0, 1.0), STEM_WIDTHS)], [STEM_TONE])
    scale = SMALLEST_SCALE + (1 - SMALLEST_SCALE) * growth
    for i, height in enumerate(heights(len(LENGTHS))):
        stance = HABIT.stance(azimuth_rad, height, rng, LENGTHS[i] * scale)
        tone = HABIT.tone.at(height, rng)
        outlines = pieces(stance, BLADE, CUTS)
        tones = [tone + step for step in TIPWARD_TONES]
        if i >= RIBLESS_LEAVES:
            outlines += pieces(stance, MIDRIB, MIDRIB_CUTS)
            tones += MIDRIB_TONES
        foliage.add(outlines, tones)
        azimuth_rad += pi
    return foliage.finish(PALETTES["maize"], HEIGHT)
