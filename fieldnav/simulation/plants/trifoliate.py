"""Leaflets in threes on a petiole: beans and soybean."""

from dataclasses import dataclass, replace
from math import radians

import numpy as np

from fieldnav.simulation.plants.habit import GOLDEN_ANGLE_RAD, Habit, Trait, any_turn_rad, heights
from fieldnav.simulation.plants.leaf import Shape, Stance, halves, leaflet, stalk, whole
from fieldnav.simulation.plants.model import Foliage, PlantModel
from fieldnav.simulation.plants.palette import PALETTES, RIB_TONE

HEART = Shape(
    stations=(-0.03, 0.06, 0.25, 0.48, 0.75, 1.0),
    half_widths=(0.18, 0.39, 0.45, 0.35, 0.16, 0.01),
)
OVAL = Shape(
    stations=(0.0, 0.12, 0.35, 0.6, 0.85, 1.0),
    half_widths=(0.05, 0.20, 0.30, 0.28, 0.14, 0.02),
)
LATERAL_STATION = 0.97
LATERAL_LENGTH = 0.92
"""Of the lateral leaflets, relative to the one ahead."""
STALKLET_LENGTH = 0.16
"""Of the leaflet ahead, relative to itself."""
PETIOLE_WIDTHS = (0.013, 0.007)
AHEAD_TONE_STEP = 0.04
"""The leaflet ahead lies highest and looks lightest."""


@dataclass(frozen=True, slots=True)
class _Trifoliate:
    """What a crop's leaves look like; the habit is the petioles', with `fold_rad` 0 all leaflets are flat."""

    petiole: Habit
    leaflet: Shape
    leaflet_length: float
    """Relative to the petiole's."""
    spread_rad: float
    fold_rad: float
    petioles_seen: int
    """How many leaves, from the lowest up, show their petiole; those higher up hide it."""
    height: float
    """Usual one of the plant, in canopy diameters."""


BEAN_LEAVES = 5
BEAN = _Trifoliate(
    Habit(
        length=Trait(0.55, 0.36, 0.03),
        rise_rad=Trait.degrees(42, 71, 6),
        bend_rad=Trait.degrees(25, 25),
        tone=Trait(0.22, 0.5, 0.05),
        base_height=Trait(0.10, 0.30),
        turn_rad=radians(10),
    ),
    leaflet=HEART,
    leaflet_length=0.9,
    spread_rad=radians(88),
    fold_rad=radians(14),
    petioles_seen=3,
    height=0.95,
)
SOYBEAN_LEAVES = 6
SOYBEAN = _Trifoliate(
    Habit(
        length=Trait(0.46, 0.29, 0.03),
        rise_rad=Trait.degrees(30, 60, 6),
        bend_rad=Trait.degrees(20, 20),
        tone=Trait(0.2, 0.54, 0.05),
        base_height=Trait(0.08, 0.44),
        turn_rad=radians(10),
    ),
    leaflet=OVAL,
    leaflet_length=0.8,
    spread_rad=radians(78),
    fold_rad=0.0,
    petioles_seen=3,
    height=0.95,
)
YOUNGEST_SCALE = 0.8
"""Length of the topmost leaves when the stage begins; they are full-sized at its end."""


def beans(growth: float, rng: np.random.Generator) -> PlantModel:
    """Few, large, heart-shaped leaflets in threes on long petioles that branch low."""
    return _grow("beans", BEAN, BEAN_LEAVES, growth, rng)


def soybean(growth: float, rng: np.random.Generator) -> PlantModel:
    """More and smaller leaves than beans, their leaflets oval, from the many nodes of an erect stem."""
    return _grow("soybean", SOYBEAN, SOYBEAN_LEAVES + round(growth), growth, rng)


def _grow(
    species: str, kind: _Trifoliate, n_leaves: int, growth: float, rng: np.random.Generator
) -> PlantModel:
    foliage = Foliage()
    azimuth_rad = any_turn_rad(rng)
    for node, height in enumerate(heights(n_leaves)):
        scale = 1 - (1 - YOUNGEST_SCALE) * (1 - growth) * height
        petiole = kind.petiole.stance(azimuth_rad, height, rng, scale)
        if node < kind.petioles_seen:
            foliage.add([stalk(petiole, (0.0, 1.0), PETIOLE_WIDTHS)], [RIB_TONE])
        _grow_leaflets(foliage, petiole, kind, height, rng)
        azimuth_rad += GOLDEN_ANGLE_RAD
    return foliage.finish(PALETTES[species], kind.height)


def _grow_leaflets(
    foliage: Foliage, petiole: Stance, kind: _Trifoliate, height: float, rng: np.random.Generator
) -> None:
    """Add two leaflets to the sides of a petiole's end and one ahead, that one folded along its midrib."""
    length = kind.leaflet_length * petiole.length
    for side in (1, -1):
        lateral = leaflet(petiole, LATERAL_STATION, side * kind.spread_rad, LATERAL_LENGTH * length, rng)
        foliage.add([whole(lateral, kind.leaflet)], [kind.petiole.tone.at(height, rng)])
    ahead = leaflet(petiole, 1.0, 0.0, length, rng)
    ahead = replace(ahead, base=ahead.point(STALKLET_LENGTH))
    tone = kind.petiole.tone.at(height, rng)
    if kind.fold_rad > 0:
        foliage.add(halves(ahead, kind.leaflet, kind.fold_rad), [tone, tone + AHEAD_TONE_STEP])
    else:
        foliage.add([whole(ahead, kind.leaflet)], [tone + AHEAD_TONE_STEP])
