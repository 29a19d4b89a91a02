"""Tufts of narrow blades: a stretch of winter wheat, a weed grass."""

from math import pi, radians

import numpy as np

from fieldnav.simulation.plants.habit import STEM_FOOT, Habit, Trait, any_turn_rad, heights
from fieldnav.simulation.plants.leaf import Shape, pieces
from fieldnav.simulation.plants.model import Foliage, PlantModel
from fieldnav.simulation.plants.palette import PALETTES

BLADE = Shape(stations=(0.0, 0.3, 0.6, 0.85, 1.0), half_widths=(0.030, 0.040, 0.034, 0.02, 0.003))
IN_ONE = (0, 4)
IN_TWO = (0, 2, 4)
"""Where a blade is cut across; one that arches needs two pieces to follow its bend."""

ARCHING_BLADES = 4
ARCHING = Habit(
    length=Trait(0.95, 0.95, 0.1),
    rise_rad=Trait.degrees(68, 68, 8),
    bend_rad=Trait.degrees(92, 92, 14),
    tone=Trait(0.5, 0.5, 0.12),
    roll_rad=radians(25),
)
ERECT_BLADES = 5
ERECT = Habit(
    length=Trait(0.75, 0.75, 0.12),
    rise_rad=Trait.degrees(64, 64, 8),
    bend_rad=Trait.degrees(15, 15),
    tone=Trait(0.52, 0.52, 0.14),
    roll_rad=radians(25),
)
TIP_TONE_STEP = 0.12
WHEAT_WIDENING = 1.35
"""Each blade painted stands for more than one that grows."""
ROW_STRETCH = 0.7
"""Length of sown row that one plant stands for."""
ROW_SCATTER = 0.05
"""Standard deviation of a seedling's place, along and across the row."""

GRASS_BLADES = 6
GRASS = Habit(
    length=Trait(0.9, 0.9, 0.12),
    rise_rad=Trait.degrees(60, 60, 12),
    bend_rad=Trait.degrees(50, 50, 15),
    tone=Trait(0.45, 0.45, 0.12),
    turn_rad=radians(15),
)
WHEAT_HEIGHT = 1.4
"""Usual height in canopy diameters."""
GRASS_HEIGHT = 0.7


def winter_wheat(growth: float, rng: np.random.Generator) -> PlantModel:
    """A short stretch of a sown row, along x: bluish blades, some erect, some arching over."""
    foliage = Foliage()
    n_blades = ARCHING_BLADES + ERECT_BLADES + round(growth)
    arching = set(rng.permutation(n_blades)[:ARCHING_BLADES].tolist())
    turn_rad = any_turn_rad(rng)
    for i, along in enumerate(heights(n_blades) - 0.5):
        habit, cuts = (ARCHING, IN_TWO) if i in arching else (ERECT, IN_ONE)
        base = (ROW_STRETCH * along + rng.normal(0, ROW_SCATTER), rng.normal(0, ROW_SCATTER), 0.0)
        azimuth_rad = turn_rad + rng.permutation(n_blades)[0] * 2 * pi / n_blades
        stance = habit.stance_from(base, azimuth_rad, 0.0, rng)
        tone = habit.tone.at(0.0, rng)
        foliage.add(
            pieces(stance, BLADE, cuts, WHEAT_WIDENING), [tone, tone + TIP_TONE_STEP][: len(cuts) - 1]
        )
    return foliage.finish(PALETTES["winter-wheat"], WHEAT_HEIGHT)


def meadow_grass(growth: float, rng: np.random.Generator) -> PlantModel:
    """A tuft of six to nine fine blades spreading from one point."""
    foliage = Foliage()
    turn_rad = any_turn_rad(rng)
    n_blades = GRASS_BLADES + round(3 * growth)
    for i in range(n_blades):
        stance = GRASS.stance_from(STEM_FOOT, turn_rad + i * 2 * pi / n_blades, 0.0, rng)
        foliage.add(pieces(stance, BLADE, IN_ONE), [GRASS.tone.at(0.0, rng)])
    return foliage.finish(PALETTES["meadow-grass"], GRASS_HEIGHT)
