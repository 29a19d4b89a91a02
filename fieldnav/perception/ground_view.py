"""The ground as a camera sees it, seen from above, and how far it has moved from one picture to the next."""

from dataclasses import dataclass, replace
from math import ceil, sqrt

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Image
from fieldnav.perception.vegetation import excess_green
from fieldnav.pinhole import Pinhole

Map = NDArray[np.float32]
"""Shape (h, w), one value a cell of ground: row 0 is furthest ahead of the camera, column 0 furthest left."""

MAP_CELLS = 8000  # of the map: a cell is then some 1 cm, a third of a plant
UPPER_EDGE = 0.2  # of the ground's height in the picture: what lies above is far away, and small
OBLIQUE_RAD = 0.9  # below the horizontal: a camera that looks less steeply sees far, where pitch moves most
OBLIQUE_LENGTH_M = 1.0  # of such a camera's map: three times what shaking moves it
SMOOTH_CELLS = 0.8  # standard deviation: sensor noise is gone, plants are not
COARSE_CELLS = (
    21  # side of the square whose mean is taken away: light and vignetting do not move with the ground
)
MIN_GREEN, MIN_GREY = 2.5, 2.0  # standard deviation of a map in grey levels; sensor noise alone leaves 1
FOUND, LOST = (
    0.5,
    0.35,
)  # correlation from which on ground is found again; below which plants are surely others
GREEN, MIN_COVER = 25, 0.02  # excess green of a plant, a tenth; share of the map that few plants cover
EDGE_M = 0.05  # of the map, into which shaking may bring a plant
STILL_CELLS, STILL_LIKENESS = 0.7, 0.95  # the robot's own shadow stands still over soil that moves; a picture
# that stands still is all alike


@dataclass(frozen=True, slots=True)
class FineMap:
    """What is coarser than noise and finer than light: plants, clods, stones; and its standard deviation."""

    cells: Map
    contrast: float


@dataclass(frozen=True, slots=True)
class GroundMap:
    """What one picture shows of the ground.

    vegetation: excess green, 0 to 255; green, grey: what is fine in it, and in the brightness.
    """

    vegetation: NDArray[np.uint8]
    green: FineMap
    grey: FineMap


@dataclass(frozen=True, slots=True)
class SeenMotion:
    """How far the ground has moved towards the camera and to its right, in metres, and how alike it looks.

    likeness: correlation; below FOUND the ground was not found again, and the motion means nothing.
    by_plants: False where bare soil was found again.
    """

    ahead_m: float
    left_m: float
    likeness: float
    by_plants: bool = True

    @property
    def found(self) -> bool:
        return self.likeness >= FOUND


class GroundView:
    """Maps the ground in front of one camera, and finds the ground of one map again in another.

    oblique: whether the camera looks so far ahead that pitch moves the ground further than the robot drives
    from one picture to the next; shake_share: how far it moves it, against a camera that looks down.
    """

    def __init__(self, camera: Pinhole) -> None:
        bottom_px, right_px = camera.height_px - 1.0, camera.width_px - 1.0
        upper_px = camera.top_px + UPPER_EDGE * (bottom_px - camera.top_px)
        corners = np.array([[0.0, bottom_px], [right_px, bottom_px], [camera.centre_x_px, upper_px]])
        left, _, upper = camera.to_ground(corners)
        near_m, half_m = float(left[0]), float(abs(left[1]))
        # A camera that looks far would map many metres: as far as it is wide is enough, and less where pitch
        # moves what is far away.
        far_m = float(np.nan_to_num(upper[0] - near_m, nan=np.inf))
        self.oblique = camera.tilt_rad < OBLIQUE_RAD
        length_m = min(far_m, 2 * half_m, OBLIQUE_LENGTH_M if self.oblique else np.inf)
        self.cell_m = sqrt(2 * half_m * length_m / MAP_CELLS)
        self.middle_m = near_m + length_m / 2
        self.shake_share = _shake_share(camera, self.middle_m - camera.forward_m) if self.oblique else 1.0
        self._size = (round(2 * half_m / self.cell_m), round(length_m / self.cell_m))
        cells = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32) * (np.array(self._size) - 1)
        ground = np.stack(
            [near_m + length_m - cells[:, 1] * self.cell_m, half_m - cells[:, 0] * self.cell_m], axis=-1
        )
        pixels = camera.to_image(ground).astype(np.float32)
        self._to_picture = cv2.getPerspectiveTransform(cells.astype(np.float32), pixels)

    @property
    def max_motion_m(self) -> float:
        """Of the ground from one map to the next, in which a third of it can still be found again."""
        return min(self._size) / 3 * self.cell_m

    def look(self, image: Image) -> GroundMap:
        """The map of a picture, shape (height, width, 3), blue green red."""
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        ground = np.asarray(
            cv2.warpPerspective(
                image, self._to_picture, self._size, flags=flags, borderMode=cv2.BORDER_REPLICATE
            ),
            np.uint8,
        )
        vegetation = excess_green(ground)
        grey = np.asarray(cv2.cvtColor(ground, cv2.COLOR_BGR2GRAY), np.uint8)
        return GroundMap(vegetation, _fine(vegetation), _fine(grey))

    def motion(self, before: GroundMap, after: GroundMap, max_m: float) -> SeenMotion | None:
        """How the ground has moved, by `max_m` at most; None where it shows nothing to be found again.

        Plants are looked for first. Bare soil that is not found again means nothing: wet, smooth or blurred
        it shows too little.
        """
        reach = min(ceil(max_m / self.cell_m), min(self._size) // 3)
        if self._contrast(before.green, after.green, reach) >= MIN_GREEN:
            return self._found(before.green, after.green, reach)
        if self._contrast(before.grey, after.grey, reach) < MIN_GREY:
            return None
        soil = replace(self._found(before.grey, after.grey, reach), by_plants=False)
        still = max(abs(soil.ahead_m), abs(soil.left_m)) < STILL_CELLS * self.cell_m
        return soil if soil.likeness >= (STILL_LIKENESS if still else FOUND) else None

    def plants_left(self, before: GroundMap, now: GroundMap, ahead_m: float, left_m: float) -> float | None:
        """Of the plants that must still be in view after a motion, the share that is; None where none must
        be."""
        down, right = round(ahead_m / self.cell_m), round(left_m / self.cell_m)
        height, width = before.vegetation.shape
        if max(abs(down), abs(right)) > min(self._size) / 2:
            return None
        here = now.vegetation[max(down, 0) : height + min(down, 0), max(right, 0) : width + min(right, 0)]
        there = before.vegetation[
            max(-down, 0) : height + min(-down, 0), max(-right, 0) : width + min(-right, 0)
        ]
        edge = ceil(self.shake_share * EDGE_M / self.cell_m)  # shaking brings plants over the map's edge
        expected = _cover(there[edge:-edge, edge:-edge])
        return _cover(here) / expected if expected >= MIN_COVER else None

    def _contrast(self, before: FineMap, after: FineMap, reach: int) -> float:
        """What both maps show; where shaking moves the ground far, within the part that is looked for."""
        least = min(before.contrast, after.contrast)
        if not self.oblique:
            return least
        return min(least, float(cv2.meanStdDev(_middle(before, reach))[1][0, 0]))

    def _found(self, before: FineMap, after: FineMap, reach: int) -> SeenMotion:
        middle = _middle(before, reach)
        alike = np.asarray(cv2.matchTemplate(after.cells, middle, cv2.TM_CCOEFF_NORMED), np.float32)
        _, likeness, _, (x, y) = cv2.minMaxLoc(alike)
        down = y + _summit(alike[:, x], y) - reach
        right = x + _summit(alike[y], x) - reach
        return SeenMotion(float(down * self.cell_m), float(right * self.cell_m), float(likeness))


def _middle(fine: FineMap, reach: int) -> Map:
    """What of a map is looked for in another one: all but what motion may bring out of view."""
    height, width = fine.cells.shape
    return np.ascontiguousarray(fine.cells[reach : height - reach, reach : width - reach])


def _shake_share(camera: Pinhole, ahead_m: float) -> float:
    """How far pitch moves the ground in view, against a camera one metre up that looks straight down."""
    return (camera.height_m**2 + ahead_m**2) / camera.height_m


def _cover(vegetation: NDArray[np.uint8]) -> float:
    """The share that is covered by plants."""
    return np.count_nonzero(vegetation > GREEN) / vegetation.size


def _fine(values: NDArray[np.uint8]) -> FineMap:
    cells = values.astype(np.float32)
    smooth = cv2.GaussianBlur(cells, (0, 0), SMOOTH_CELLS)
    fine = np.asarray(smooth - cv2.blur(cells, (COARSE_CELLS, COARSE_CELLS)), np.float32)
    return FineMap(fine, float(cv2.meanStdDev(fine)[1][0, 0]))


def _summit(values: Map, place: int) -> float:
    """Where between its neighbours a maximum lies, in cells from its place: the summit of their parabola."""
    if not 0 < place < len(values) - 1:
        return 0.0
    left, top, right = (float(value) for value in values[place - 1 : place + 2])
    curvature = left - 2 * top + right
    return 0.5 * (left - right) / curvature if curvature < 0 else 0.0
