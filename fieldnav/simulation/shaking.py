"""The robot's shaking: roll, pitch and height as slow oscillations that grow with the speed it drives at."""

from dataclasses import dataclass
from math import cos, pi, radians, sin, sqrt

import numpy as np

from fieldnav.messages import Floats
from fieldnav.settings.field import CameraErrors
from fieldnav.simulation.streams import Stream, random_stream

OSCILLATIONS = 3
FULL_SPEED_MPS = 0.15
"""From this speed on the ground's unevenness shakes the robot fully; a robot that stands does not shake."""


@dataclass(frozen=True, slots=True)
class Attitude:
    """Departure from level: roll about the robot's x, pitch about its y (the front goes down), and height."""

    roll_rad: float = 0.0
    pitch_rad: float = 0.0
    height_m: float = 0.0


class Shaking:
    """A sum of a few sines each, with the rms and the frequencies of the field file."""

    def __init__(self, errors: CameraErrors, seed: int, mirrored: bool) -> None:
        random = random_stream(seed, Stream.SHAKING)
        self._errors = errors
        self._roll_sign = -1 if mirrored else 1
        low, high = errors.shake_hz
        # One frequency from each part of the band: two that are nearly alike would beat.
        share = (np.arange(OSCILLATIONS) + random.uniform(0, 1, (3, OSCILLATIONS))) / OSCILLATIONS
        self._angular_rps = 2 * pi * (low + (high - low) * share)
        self._phase_rad = random.uniform(0, 2 * pi, (3, OSCILLATIONS))

    def at(self, stamp_s: float, speed_mps: float) -> Attitude:
        """Attitude at a time while driving at a speed."""
        share = min(1.0, abs(speed_mps) / FULL_SPEED_MPS) * sqrt(2 / OSCILLATIONS)
        roll, pitch, height = np.sin(self._angular_rps * stamp_s + self._phase_rad).sum(axis=1) * share
        rms_rad = radians(self._errors.shake_deg)
        # Height: the sum stays within its bound for all but rare coincidences of the oscillations.
        bounce_m = self._errors.bounce_m / 2
        roll_rad = self._roll_sign * float(roll) * rms_rad
        return Attitude(roll_rad, float(pitch) * rms_rad, float(height) * bounce_m)


def rotation(attitude: Attitude, looking: int, heading_rad: float, tilt_rad: float) -> Floats:
    """Rotation, shape (3, 3), camera to world, of a camera that looks towards a heading and down by the tilt.

    looking: +1 for a camera that looks ahead, -1 for one that looks back and rolls and pitches the other way.
    """
    tilt, roll = tilt_rad + looking * attitude.pitch_rad, looking * attitude.roll_rad
    level = np.array([[0, -sin(tilt), cos(tilt)], [-1, 0, 0], [0, -cos(tilt), -sin(tilt)]])
    rolled = np.array([[1, 0, 0], [0, cos(roll), -sin(roll)], [0, sin(roll), cos(roll)]]) @ level
    turn = [[cos(heading_rad), -sin(heading_rad), 0], [sin(heading_rad), cos(heading_rad), 0], [0, 0, 1]]
    return np.asarray(np.array(turn) @ rolled)
