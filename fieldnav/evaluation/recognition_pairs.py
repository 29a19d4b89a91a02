"""Labelled pairs of looks at rows: the same row some way on, or another at the same place of the view."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from fieldnav.evaluation.recognition_scene import RowNumber, RowsSeen
from fieldnav.messages import RowLine
from fieldnav.perception.canopy import canopy_plane, line_px
from fieldnav.perception.recognition import Descriptors, describe
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

NEAR_M, FAR_M = (0.01, 0.15), (0.15, 0.40)
"""Way between two looks at the same row: as long as a reference is refreshed, and the hard ones."""

SAME_PLACE_M = 0.06  # two rows lie at the same place of two pictures within this
MOST_OF_A_KIND = 60  # from one sidestep, so that no field outweighs the others
LOOK_AT = 0.25  # of the picture's height: where the places of rows are compared


@dataclass(frozen=True, slots=True)
class Look:
    """One row in one picture: where the robot was, where the row lies left of it, and its features."""

    number: RowNumber
    right_m: float
    left_m: float
    features: Descriptors


@dataclass(frozen=True, slots=True)
class RowPair:
    """A row known and a row met later, `apart_m` further sideways."""

    reference: Look
    candidate: Look

    @property
    def is_new(self) -> bool:
        return self.reference.number != self.candidate.number

    @property
    def apart_m(self) -> float:
        return abs(self.candidate.right_m - self.reference.right_m)


def looks_of(seen: RowsSeen, crop: CropProfile, camera: Pinhole) -> list[Look]:
    """Every row that shows in a picture, described in its upper half, where row ends are seen."""
    return [
        Look(
            number,
            seen.right_m,
            _left_m(line, crop, camera),
            describe(seen.image, line, crop, camera, 0.0, camera.centre_y_px),
        )
        for number, line in seen.lines.items()
    ]


def balanced_pairs(pictures: Sequence[Sequence[Look]], random: np.random.Generator) -> list[RowPair]:
    """As many pairs of two rows as of one, and of these as many near as far; pictures come in their order."""
    pairs = [
        RowPair(reference, candidate)
        for earlier, later in combinations(pictures, 2)
        for reference in earlier
        for candidate in later
    ]
    same = [pair for pair in pairs if not pair.is_new]
    near, far = ([pair for pair in same if low < pair.apart_m <= high] for low, high in (NEAR_M, FAR_M))
    new = [pair for pair in pairs if pair.is_new and _at_the_same_place(pair)]
    each = min(len(near), len(far), len(new) // 2, MOST_OF_A_KIND // 2)
    return [
        *_drawn(near, each, random),
        *_drawn(far, each, random),
        *_drawn(new, 2 * each, random),
    ]


def _left_m(line: RowLine, crop: CropProfile, camera: Pinhole) -> float:
    plane = canopy_plane(camera, crop)
    y = np.array([LOOK_AT * camera.height_px])
    return float(plane.to_ground(np.stack([line_px(line, y, camera), y], axis=-1))[0, 1])


def _at_the_same_place(pair: RowPair) -> bool:
    return abs(pair.reference.left_m - pair.candidate.left_m) <= SAME_PLACE_M


def _drawn(pairs: Sequence[RowPair], count: int, random: np.random.Generator) -> list[RowPair]:
    return [pairs[index] for index in random.permutation(len(pairs))[:count]]
