"""Leaf geometry: how a leaf is held, and the outlines of its whole blade, its halves and its ribs."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import radians

import numpy as np

from fieldnav.messages import Floats

STRAIGHTEST_RAD = 1e-4
"""Bends below this are calculated as this one, to divide by something."""
RIB_STATIONS = 4
"""Points along a half leaf's midrib."""
LEAFLET_TURN_RAD = radians(7)
LEAFLET_ROLL_RAD = radians(13)
"""Standard deviations about the leaflet's place."""
LEAFLET_RISE_RAD = (radians(4), radians(9))
LEAFLET_BEND_RAD = (radians(38), radians(8))
"""Means and standard deviations."""


@dataclass(frozen=True, slots=True)
class Stance:
    """How a leaf is held: from `base` towards `azimuth_rad`, its midrib an arc of `length`.

    The midrib leaves the base `rise_rad` above the horizontal and bends down by `bend_rad` up to its tip;
    `roll_rad` turns the blade about the midrib, its left side up when positive.
    """

    base: tuple[float, float, float]
    azimuth_rad: float
    rise_rad: float
    bend_rad: float
    length: float
    roll_rad: float = 0.0

    def pitch_rad(self, station: Floats) -> Floats:
        """Angle of the midrib above the horizontal at stations 0 (base) to 1 (tip)."""
        return self.rise_rad - self._bend_rad * station

    def midrib(self, station: Floats) -> Floats:
        """Points on the midrib, shape (n, 3), at stations of shape (n,)."""
        pitch = self.pitch_rad(station)
        scale = self.length / self._bend_rad
        out = (np.sin(self.rise_rad) - np.sin(pitch)) * scale
        up = (np.cos(pitch) - np.cos(self.rise_rad)) * scale
        away = np.stack([out * np.cos(self.azimuth_rad), out * np.sin(self.azimuth_rad), up], axis=-1)
        return np.asarray(self.base + away)

    def point(self, station: float) -> tuple[float, float, float]:
        """One point on the midrib."""
        x, y, z = self.midrib(np.array([station]))[0]
        return float(x), float(y), float(z)

    def edge(self, station: Floats, half_width: Floats, side: int, fold_rad: float = 0.0) -> Floats:
        """Points on the left (side 1) or right (-1) edge, shape (n, 3); a folded leaf's edges stand up."""
        pitch = self.pitch_rad(station)
        cos_azimuth, sin_azimuth = np.cos(self.azimuth_rad), np.sin(self.azimuth_rad)
        level = np.stack([-sin_azimuth, cos_azimuth, 0.0])
        upward = np.stack(
            [-np.sin(pitch) * cos_azimuth, -np.sin(pitch) * sin_azimuth, np.cos(pitch)], axis=-1
        )
        angle = fold_rad + side * self.roll_rad
        across = side * np.cos(angle) * level + np.sin(angle) * upward
        return np.asarray(self.midrib(station) + half_width[:, None] * across)

    @property
    def _bend_rad(self) -> float:
        return self.bend_rad if abs(self.bend_rad) > STRAIGHTEST_RAD else STRAIGHTEST_RAD


@dataclass(frozen=True, slots=True)
class Shape:
    """A blade's half widths, in lengths of the leaf, at stations along it; lobes may lie behind station 0."""

    stations: tuple[float, ...]
    half_widths: tuple[float, ...]

    def arrays(self, widen: float | Floats = 1.0) -> tuple[Floats, Floats]:
        """Stations and half widths, shape (n,) each, the widths times `widen`."""
        return np.array(self.stations), np.array(self.half_widths) * widen


def whole(stance: Stance, shape: Shape, widen: float | Floats = 1.0) -> Floats:
    """Outline of a flat blade, shape (2 * stations, 3)."""
    stations, half_widths = shape.arrays(widen)
    half_widths = half_widths * stance.length
    left = stance.edge(stations, half_widths, 1)
    right = stance.edge(stations, half_widths, -1)
    return np.concatenate([left, right[::-1]])


def halves(stance: Stance, shape: Shape, fold_rad: float, widen: float | Floats = 1.0) -> list[Floats]:
    """Outlines of the left and right half of a blade folded along its midrib, each (stations + 4, 3)."""
    stations, half_widths = shape.arrays(widen)
    half_widths = half_widths * stance.length
    rib = stance.midrib(np.linspace(stations[-1], max(stations[0], 0.0), RIB_STATIONS))
    return [np.concatenate([stance.edge(stations, half_widths, side, fold_rad), rib]) for side in (1, -1)]


def stalk(stance: Stance, reach: tuple[float, float], widths: tuple[float, float]) -> Floats:
    """Outline of a straight petiole or stretch of midrib between two stations, tapering; shape (4, 3).

    A longer bent one is made of several: as one outline it would be crossed four times by a scan line.
    """
    stations, half_widths = np.array(reach), np.array(widths) / 2
    left = stance.edge(stations, half_widths, 1)
    right = stance.edge(stations, half_widths, -1)
    return np.concatenate([left, right[::-1]])


def pieces(stance: Stance, shape: Shape, cuts: Sequence[int], widen: float = 1.0) -> list[Floats]:
    """A long blade cut across into flat pieces that follow its bend.

    `cuts` are indices into the shape's stations, first to last; a piece runs between two of them.
    """
    stations, half_widths = shape.arrays(widen)
    half_widths = half_widths * stance.length
    left = stance.edge(stations, half_widths, 1)
    right = stance.edge(stations, half_widths, -1)
    spans = pairwise(cuts)
    return [np.concatenate([left[a : b + 1], right[a : b + 1][::-1]]) for a, b in spans]


def leaflet(
    parent: Stance, station: float, turn_rad: float, length: float, rng: np.random.Generator
) -> Stance:
    """A leaflet at a station of its parent's midrib, turned from the parent's azimuth, held about level."""
    return Stance(
        base=parent.point(station),
        azimuth_rad=parent.azimuth_rad + turn_rad + rng.normal(0, LEAFLET_TURN_RAD),
        rise_rad=rng.normal(*LEAFLET_RISE_RAD),
        bend_rad=rng.normal(*LEAFLET_BEND_RAD),
        length=length,
        roll_rad=rng.normal(0, LEAFLET_ROLL_RAD),
    )
