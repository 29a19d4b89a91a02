"""How the wind moves leaves: to and fro along the wind, more the higher they are."""

from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from fieldnav.simulation.streams import Stream, random_stream

Reals = NDArray[np.float32]

BEND_PER_MPS2 = 0.0025  # displacement of a plant's top over its height, per square of the wind's speed
LARGEST_BEND = 0.25
SWING_HZ, FLUTTER_HZ = 1.1, 2.7
FLUTTER = 0.35  # amplitude of the flutter over that of the swing


@dataclass(frozen=True, slots=True)
class Wind:
    """direction: unit vector (2,) in the world; bend: amplitude of a plant's top over its height."""

    direction: Reals
    bend: float

    def displacement(self, height_m: Reals, phase_rad: Reals, time_s: float) -> Reals:
        """How far leaves at `height_m`, shape (n,), of plants of a phase, shape (n,), are moved: (n, 3)."""
        swing = np.sin(2 * pi * SWING_HZ * time_s + phase_rad)
        flutter = np.sin(2 * pi * FLUTTER_HZ * time_s + 2 * phase_rad)
        amount = self.bend * height_m * (swing + FLUTTER * flutter)
        return np.asarray(np.outer(amount, [*self.direction, 0]), dtype=np.float32)


def make_wind(speed_mps: float, seed: int) -> Wind:
    """Wind of a speed from a direction that is the field's own."""
    angle = random_stream(seed, Stream.WIND).uniform(0, 2 * pi)
    bend = min(BEND_PER_MPS2 * speed_mps**2, LARGEST_BEND)
    return Wind(np.array([cos(angle), sin(angle)], np.float32), bend)
