"""The plan of a simulated field: where every row runs and every plant stands. The ground truth."""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from fieldnav.errors import SettingsError
from fieldnav.messages import Floats, Side
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings, Shape
from fieldnav.settings.placement import check_places
from fieldnav.simulation.centreline import Centreline
from fieldnav.simulation.grass import grow_grass
from fieldnav.simulation.plants import CROP_SPECIES, WEED_SPECIES
from fieldnav.simulation.rowlines import RowLines, draw_rows
from fieldnav.simulation.sowing import sow_crop
from fieldnav.simulation.stand import Stand
from fieldnav.simulation.weeding import grow_weeds

WIDEST_BEND = 0.8  # share of the radius that the lanes may take up before the inner ones fold
STEEPEST_SWING_RAD = pi / 2  # past this a bend would run back across the field


@dataclass(frozen=True, slots=True)
class FieldPlan:
    """A sown field.

    s_first_m, s_last_m: shape (lanes, rows), s of each row's first and last plant, of a row without plants
    where it would have begun and ended; sown: shape (lanes, rows), which rows have plants;
    species: names that the plants' species index, the crop first.
    """

    centreline: Centreline
    rows: RowLines
    plants: Stand
    s_first_m: Floats
    s_last_m: Floats
    sown: NDArray[np.bool_]
    species: tuple[str, ...]
    mirrored: bool
    tree: cKDTree

    @property
    def lanes(self) -> int:
        return len(self.rows.lane_n_m)

    @property
    def rows_per_lane(self) -> int:
        return int(self.rows.row_n_m.shape[1])

    @property
    def sown_lanes(self) -> tuple[int, ...]:
        """The lanes that have a crop to be driven over, in order; one without any row is passed by."""
        return tuple(np.flatnonzero(self.sown.any(axis=1)).tolist())

    def lane_span_m(self, lane: int) -> tuple[float, float]:
        """s where the first row of a lane begins and the last one ends, of those that have plants.

        Of a lane without any: where they would have.
        """
        there = self.sown[lane] if self.sown[lane].any() else np.ones(self.rows_per_lane, bool)
        return float(self.s_first_m[lane, there].min()), float(self.s_last_m[lane, there].max())

    def plants_near(self, xy: ArrayLike, radius_m: float) -> NDArray[np.int64]:
        """Indices of the plants whose stems stand within `radius_m` of a world point (2,), in order."""
        return np.array(self.tree.query_ball_point(xy, radius_m, return_sorted=True), dtype=np.int64)

    def in_lane(self, lane: int, xy: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """(s, offset, heading) of world points (..., 2) against the middle of a lane's rows.

        The offset is positive to the left of it; the heading is the rows' direction there, in the world.
        """
        s, n, heading = self.centreline.project(xy)
        step = self.rows.s_m[1] - self.rows.s_m[0]
        rise = self.rows.lane_n(lane, s + step) - self.rows.lane_n(lane, s - step)
        stretch = 1 - n * self.centreline.curvature(s)
        return s, n - self.rows.lane_n(lane, s), heading + np.arctan2(rise, 2 * step * stretch)


def sow(field: FieldSettings, crop: CropProfile, side: Side) -> FieldPlan:
    """Sow a field whose lanes follow each other on the given side; the same seed gives the same plants.

    Lane k runs parallel to lane 0 at k times the lane pitch. A mirrored field is the exact mirror image of
    the plain field that is sown to the other side.

    Raises SettingsError for a crop that cannot be drawn, for bends too tight for the lanes, and for gaps and
    unsown rows that are not in the field.
    """
    check_places(field, crop)
    line = _centreline(field)
    rows = draw_rows(field, crop, -side.sign if field.mirrored else side.sign)
    crops = sow_crop(field, crop, line, rows)
    wild = [grow_weeds(field, crop, line, rows, len(WEED_SPECIES)), grow_grass(field, line, rows)]
    plants, order = Stand.joined([crops.plants, *wild]), slice(None)
    if field.mirrored:
        line, rows, plants = line.mirrored(), rows.mirrored(), plants.mirrored(crop.rows.per_lane)
        order = slice(None, None, -1)
    return FieldPlan(
        centreline=line,
        rows=rows,
        plants=plants,
        s_first_m=crops.first_m[:, order],
        s_last_m=crops.last_m[:, order],
        sown=crops.exists[:, order],
        species=(crop_species(crop.name), *WEED_SPECIES),
        mirrored=field.mirrored,
        tree=cKDTree(np.stack([plants.x_m, plants.y_m], axis=-1)),
    )


def crop_species(name: str) -> str:
    """The species to draw for a crop profile: the one whose name the profile's begins with."""
    for species in CROP_SPECIES:
        if name.startswith(species):
            return species
    raise SettingsError(
        f"crop {name}: the simulation cannot draw it; names it knows begin with {', '.join(CROP_SPECIES)}"
    )


def _centreline(field: FieldSettings) -> Centreline:
    rows = field.rows
    if rows.shape is Shape.STRAIGHT:
        return Centreline(field.length_m)
    widest_m = WIDEST_BEND * rows.radius_m
    if field.lanes * field.lane_pitch_m > widest_m:
        raise SettingsError(
            f"field {field.name}: lanes: {field.lanes} lanes of {field.lane_pitch_m} m do not fit a bend of "
            f"rows.radius_m {rows.radius_m}; at most {int(widest_m / field.lane_pitch_m)} lanes do"
        )
    longest_m = STEEPEST_SWING_RAD * pi * rows.radius_m
    if rows.wavelength_m > longest_m:
        raise SettingsError(
            f"field {field.name}: rows.wavelength_m: {rows.wavelength_m} is too long for rows.radius_m "
            f"{rows.radius_m}; at most {longest_m:.0f} m"
        )
    return Centreline(field.length_m, 1 / rows.radius_m, rows.wavelength_m)
