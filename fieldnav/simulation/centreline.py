"""The centre line of the first lane: the curve that every row of the field runs parallel to.

Field coordinates: s along the centre line from its start, n to the left of it, both in metres. World
coordinates: x along the centre line at its start, y to the left.
"""

from math import pi

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial import cKDTree

from fieldnav.messages import Floats

NODE_STEP_M = 0.1  # cubic Hermite pieces of this length depart from the curve by less than a micrometre
QUADRATURE_POINTS = 5  # Gauss-Legendre, exact to rounding over one step
NEWTON_STEPS = 8
SMALLEST_STRETCH = 0.2  # of 1 - n * curvature; keeps Newton's step finite near the centre of a bend


class Centreline:
    """A line of curvature sin(2 pi s / wavelength) / radius between s = 0 and its length, straight beyond."""

    def __init__(self, length_m: float, curvature_per_m: float = 0.0, wavelength_m: float = 1.0) -> None:
        self.length_m = length_m
        self.curvature_per_m = curvature_per_m
        self.wavelength_m = wavelength_m
        nodes = np.linspace(0.0, length_m, max(2, round(length_m / NODE_STEP_M) + 1))
        heading = self.heading(nodes)
        tangents = np.stack([np.cos(heading), np.sin(heading)], axis=-1)
        points = self._integrate(nodes)
        self._curve = CubicHermiteSpline(nodes, points, tangents)
        self._nodes = nodes
        self._tree = cKDTree(points)

    def mirrored(self) -> "Centreline":
        """The same line with left and right exchanged."""
        return Centreline(self.length_m, -self.curvature_per_m, self.wavelength_m)

    def curvature(self, s: ArrayLike) -> Floats:
        """Curvature at `s`, 1/m, positive to the left; zero beyond both ends."""
        at = np.asarray(s, dtype=float)
        within = (at >= 0) & (at <= self.length_m)
        return np.where(within, self.curvature_per_m * np.sin(2 * pi * at / self.wavelength_m), 0.0)

    def heading(self, s: ArrayLike) -> Floats:
        """Direction of travel at `s`, rad, counter-clockwise from the world's x."""
        within = np.clip(np.asarray(s, dtype=float), 0.0, self.length_m)
        swing = self.curvature_per_m * self.wavelength_m / (2 * pi)
        return np.asarray(swing * (1 - np.cos(2 * pi * within / self.wavelength_m)))

    def position(self, s: ArrayLike, n: ArrayLike = 0.0) -> Floats:
        """World points, shape (..., 2), at distances `s` along the line and `n` to its left."""
        s, n = np.broadcast_arrays(np.asarray(s, dtype=float), np.asarray(n, dtype=float))
        within = np.clip(s, 0.0, self.length_m)
        heading = self.heading(within)
        tangent = np.stack([np.cos(heading), np.sin(heading)], axis=-1)
        normal = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
        on_line = np.asarray(self._curve(within))
        return np.asarray(on_line + (s - within)[..., None] * tangent + n[..., None] * normal)

    def way_m(self, s: ArrayLike, n: float) -> Floats:
        """How far it is along a line `n` to the left, to the point beside `s`, from the one beside 0.

        The integral of 1 - n * curvature: a line inside of a bend is shorter.
        """
        return np.asarray(np.asarray(s, dtype=float) - n * self.heading(s))

    def s_after(self, way_m: ArrayLike, n: float) -> Floats:
        """The inverse of way_m: the s beside which one is after so far along a line `n` to the left."""
        way = np.asarray(way_m, dtype=float)
        if n * self.curvature_per_m == 0:
            return way
        ends = self.way_m([0.0, self.length_m], n)
        within = np.interp(way, self.way_m(self._nodes, n), self._nodes)
        return np.asarray(within + np.minimum(way - ends[0], 0) + np.maximum(way - ends[1], 0))

    def project(self, xy: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """(s, n, heading of the line there) of the nearest point of the line to world points (..., 2)."""
        xy = np.asarray(xy, dtype=float)
        if self.curvature_per_m == 0:
            return xy[..., 0], xy[..., 1], np.zeros(xy.shape[:-1])
        s = self._nodes[self._tree.query(xy)[1]]
        along, across = self._offset(xy, s)
        for _ in range(NEWTON_STEPS):
            s = s + along / np.maximum(1 - across * self.curvature(s), SMALLEST_STRETCH)
            along, across = self._offset(xy, s)
        return s, across, self.heading(s)

    def _offset(self, xy: Floats, s: Floats) -> tuple[Floats, Floats]:
        """Distance of `xy` ahead of and to the left of the line's point at `s`."""
        heading = self.heading(s)
        away = xy - self.position(s)
        cosine, sine = np.cos(heading), np.sin(heading)
        return away[..., 0] * cosine + away[..., 1] * sine, away[..., 1] * cosine - away[..., 0] * sine

    def _integrate(self, nodes: Floats) -> Floats:
        """The line's points at `nodes`, by quadrature of its direction over each step."""
        abscissae, weights = np.polynomial.legendre.leggauss(QUADRATURE_POINTS)
        half = np.diff(nodes)[:, None] / 2
        heading = self.heading(nodes[:-1, None] + half * (1 + abscissae))
        steps = np.stack([(half * weights * f(heading)).sum(axis=1) for f in (np.cos, np.sin)], axis=-1)
        return np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])
