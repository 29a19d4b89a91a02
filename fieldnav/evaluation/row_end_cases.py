"""Lanes driven to see where they are taken for ended: long ones full of gaps, short ones with ragged ends.

The seed decides everything: the crop, how many weeds, and what the robot knows of the lanes before.
"""

from collections.abc import Iterator
from enum import Enum
from typing import Any

import numpy as np

from fieldnav.evaluation.row_end_drive import LaneRun
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, names_of, revised
from fieldnav.settings.robot import Robot

GAPPY_FIELD, RAGGED_FIELD = "sim-large-gaps", "demo"
RAGGED_M = 0.3
RAGGED_LENGTH_M = 8.0
WEEDY: dict[str, Any] = {"per_m2": 4.0, "large": 0.1}
"""Weeds of every other lane: as many as crop plants in some crops, a tenth of them as large."""
ROW_GAP_AT, ROW_GAP_M = 0.3, 5.0
LANE_GAP_AT, LANE_GAP_M = 0.6, 2.0
"""Gaps that are placed in any lane: where, as a share of its length, and how long."""
ALIKE_SD_M = 0.3
ODD = (0.7, 1.4)
"""What the lane before was measured to be: as this one but for ragged ends, or this share of its length."""
SMALLER = 2
"""Vegetation is looked for at half the cameras' size, so a picture of that size shows as much."""


class Before(Enum):
    """What the robot has driven before it comes to the lane."""

    NOTHING = "nothing"
    ALIKE = "alike"
    ODD = "odd"


def gappy_runs(lanes: int, length_m: float, seed: int, robot: Robot) -> Iterator[LaneRun]:
    """Lanes of the field of large gaps, with one of each kind placed besides those drawn."""
    plain, small = load_field(GAPPY_FIELD), smaller(robot)
    placed = [
        {"lane": 1, "row": 1, "start_m": ROW_GAP_AT * length_m, "length_m": ROW_GAP_M},
        {"lane": 1, "start_m": LANE_GAP_AT * length_m, "length_m": LANE_GAP_M},
    ]
    gaps = plain.gaps.model_dump(mode="json") | {"placed": placed}
    for each in range(seed, seed + lanes):
        yield _run(plain, {"length_m": length_m, "gaps": gaps}, each, small)


def ragged_runs(lanes: int, seed: int, robot: Robot) -> Iterator[LaneRun]:
    """Short lanes whose rows end within plus or minus RAGGED_M, the headland's weeds as shipped."""
    plain, small = load_field(RAGGED_FIELD), smaller(robot)
    rows = plain.rows.model_dump(mode="json") | {"ragged_m": RAGGED_M}
    for each in range(seed, seed + lanes):
        yield _run(plain, {"length_m": RAGGED_LENGTH_M, "rows": rows}, each, small)


def smaller(robot: Robot, times: int = SMALLER) -> Robot:
    """The robot with cameras so many times smaller and the same view: drawn and seen in less time."""
    cameras = robot.model_dump(mode="json")["cameras"]
    for camera in cameras.values():
        camera["width_px"] //= times
        camera["height_px"] //= times
    return revised(robot, {"cameras": cameras})


def _run(plain: FieldSettings, changes: dict[str, Any], seed: int, robot: Robot) -> LaneRun:
    """Eight seeds in a row have every crop; the next eight the other weeds and another lane before."""
    crops = names_of(Kind.CROP)
    turn, place = divmod(seed, len(crops))
    weeds = plain.weeds.model_dump(mode="json") | (WEEDY if turn % 2 else {})
    named = {"crop": crops[place], "seed": seed, "lanes": 1, "weeds": weeds}
    field = revised(plain, changes | named)
    return LaneRun(field, load_crop(field.crop), robot, _expected_m(field, list(Before)[turn % len(Before)]))


def _expected_m(field: FieldSettings, before: Before) -> float | None:
    random = np.random.default_rng(field.seed)
    match before:
        case Before.NOTHING:
            return None
        case Before.ALIKE:
            return field.length_m + ALIKE_SD_M * float(random.standard_normal())
        case Before.ODD:
            return field.length_m * float(random.uniform(*ODD))
