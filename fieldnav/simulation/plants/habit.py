"""How a species holds its leaves: figures that change up the plant and vary from leaf to leaf."""

from dataclasses import dataclass
from math import pi, radians, sqrt

import numpy as np

from fieldnav.messages import Floats
from fieldnav.simulation.plants.leaf import Stance

GOLDEN_ANGLE_RAD = pi * (3 - sqrt(5))
"""Between one leaf of a spiral and the next."""
STEM_FOOT = (0.0, 0.0, 0.0)
HEART_VERTICES = 10
HEART_UNEVENNESS = (0.75, 1.15)
"""Range of the distances of a heart's vertices from the stem, in radii."""


@dataclass(frozen=True, slots=True)
class Trait:
    """A figure of a plant's lowest, oldest leaf and of its topmost, youngest; `scatter` is the deviation."""

    lowest: float
    topmost: float
    scatter: float = 0.0

    @classmethod
    def degrees(cls, lowest: float, topmost: float, scatter: float = 0.0) -> "Trait":
        """An angle, given in degrees and held in radians."""
        return cls(radians(lowest), radians(topmost), radians(scatter))

    def at(self, height: float, rng: np.random.Generator) -> float:
        """The figure of one leaf at a relative height, 0 lowest to 1 topmost."""
        return self.lowest + (self.topmost - self.lowest) * height + self.scatter * rng.standard_normal()


@dataclass(frozen=True, slots=True)
class Habit:
    """How a species holds its leaves, or the petioles of its compound leaves.

    `length` and `base_height` are in any one unit; `turn_rad` and `roll_rad` are standard deviations of the
    azimuth and of the roll; `tone` is the place in the palette.
    """

    length: Trait
    rise_rad: Trait
    bend_rad: Trait
    tone: Trait
    base_height: Trait = Trait(0.0, 0.0)
    turn_rad: float = 0.0
    roll_rad: float = 0.0

    def stance(
        self, azimuth_rad: float, height: float, rng: np.random.Generator, scale: float = 1.0
    ) -> Stance:
        """One leaf from the plant's axis; `scale` multiplies its length."""
        return self.stance_from((0.0, 0.0, self.base_height.at(height, rng)), azimuth_rad, height, rng, scale)

    def stance_from(
        self,
        base: tuple[float, float, float],
        azimuth_rad: float,
        height: float,
        rng: np.random.Generator,
        scale: float = 1.0,
    ) -> Stance:
        """One leaf from a point of its own."""
        return Stance(
            base=base,
            azimuth_rad=azimuth_rad + self.turn_rad * rng.standard_normal(),
            rise_rad=self.rise_rad.at(height, rng),
            bend_rad=self.bend_rad.at(height, rng),
            length=self.length.at(height, rng) * scale,
            roll_rad=self.roll_rad * rng.standard_normal(),
        )


def heights(n_leaves: int) -> Floats:
    """Relative heights of leaves from the lowest to the topmost, shape (n_leaves,)."""
    return np.linspace(0, 1, n_leaves)


def any_turn_rad(rng: np.random.Generator) -> float:
    """Any azimuth, all alike."""
    return float(rng.uniform(0, 2 * pi))


def dark_heart(radius: float, height: float, rng: np.random.Generator) -> Floats:
    """The shaded inside of a bush: an uneven level polygon, shape (10, 3), to lie under the leaves."""
    angles = np.linspace(0, 2 * pi, HEART_VERTICES, endpoint=False)
    reach = radius * rng.uniform(*HEART_UNEVENNESS, HEART_VERTICES)
    return np.stack(
        [reach * np.cos(angles), reach * np.sin(angles), np.full(HEART_VERTICES, height)], axis=-1
    )
