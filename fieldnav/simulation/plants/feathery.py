"""Feathery plants: small lobed leaflets on thin stalks that branch (coriander)."""

from math import radians

import numpy as np

from fieldnav.simulation.plants.habit import GOLDEN_ANGLE_RAD, Habit, Trait, any_turn_rad, heights
from fieldnav.simulation.plants.leaf import Shape, stalk, whole
from fieldnav.simulation.plants.model import Foliage, PlantModel
from fieldnav.simulation.plants.palette import PALETTES, RIB_TONE

LEAVES = 4
STALKS_SEEN = 2
"""Lowest leaves, whose stalk shows."""
STALK_WIDTHS = (0.03, 0.02)
STALK = Habit(
    length=Trait(0.8, 0.8, 0.06),
    rise_rad=Trait.degrees(42, 70, 6),
    bend_rad=Trait.degrees(25, 25),
    tone=Trait(0.3, 0.52, 0.07),
    turn_rad=radians(12),
)
SMALLEST_SCALE = 0.85
"""Length of the stalks when the stage begins; 1 at its end."""
LEAFLETS = ((1.0, 0.0), (0.72, radians(75)), (0.72, radians(-75)))
"""Place on the stalk and turn away from it of a leaf's three leaflets."""
LOBED_FAN = Shape(
    stations=(0.0, 0.35, 0.72, 0.70, 1.0, 0.96),
    half_widths=(0.03, 0.26, 0.50, 0.26, 0.22, 0.03),
)
FAN = Habit(
    length=Trait(0.46, 0.46, 0.035),
    rise_rad=Trait.degrees(15, 15, 12),
    bend_rad=Trait.degrees(25, 25),
    tone=STALK.tone,
    turn_rad=radians(10),
    roll_rad=radians(15),
)
HEIGHT = 1.05
"""Usual height in canopy diameters."""


def coriander(growth: float, rng: np.random.Generator) -> PlantModel:
    """Leaves of three small fan-shaped, lobed leaflets, each held out by a thread of a stalk."""
    foliage = Foliage()
    azimuth_rad = any_turn_rad(rng)
    scale = SMALLEST_SCALE + (1 - SMALLEST_SCALE) * growth
    for i, height in enumerate(heights(LEAVES)):
        thread = STALK.stance(azimuth_rad, height, rng, scale)
        if i < STALKS_SEEN:
            foliage.add([stalk(thread, (0.0, 1.0), STALK_WIDTHS)], [RIB_TONE])
        for station, turn_rad in LEAFLETS:
            fan = FAN.stance_from(thread.point(station), thread.azimuth_rad + turn_rad, height, rng)
            foliage.add([whole(fan, LOBED_FAN)], [FAN.tone.at(height, rng)])
        azimuth_rad += GOLDEN_ANGLE_RAD
    return foliage.finish(PALETTES["coriander"], HEIGHT)
