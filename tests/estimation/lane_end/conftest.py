"""A lane as the leading camera sees it pass: where plants stand along it, and what is judged on the way."""

from collections.abc import Sequence
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.estimation.lane_end import LaneEnd, LaneEndView
from fieldnav.messages import Floats
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop

BEET = load_crop("sugar-beet")
NEAR_M, FAR_M = 0.95, 1.75
FRAME_M = 0.05
SURE = 0.95


def rows(crop: CropProfile, ends_m: Sequence[float], seed: int = 0, keep: float = 1.0) -> list[Floats]:
    """Where plants stand along each row of a lane, whole regions apart, up to each row's end."""
    random = np.random.default_rng(seed)
    spacing = max(crop.plants.spacing_m, crop.plants.canopy_width_m)
    stand = []
    for end_m in ends_m:
        s = np.arange(end_m, -1.0, -spacing)
        s = s - np.abs(random.normal(0, 0.01, len(s)))
        stand.append(s[random.random(len(s)) < keep])
    return stand


def lane(crop: CropProfile, length_m: float, seed: int = 0, keep: float = 1.0) -> Floats:
    return np.concatenate(rows(crop, [length_m] * crop.rows.per_lane, seed, keep))


def outside(s: Floats, from_m: float, to_m: float) -> Floats:
    return s[(s <= from_m) | (s >= to_m)]


def drive(
    end: LaneEnd, plants: Floats, to_m: float, weight: Floats | None = None, from_m: float = 0.0
) -> list[tuple[float, LaneEndView]]:
    """The leading camera's frames on the way; how far the robot was, and the judgement, after each."""
    weights = np.ones(len(plants)) if weight is None else weight
    judged = []
    for at_m in np.arange(from_m, to_m, FRAME_M):
        view = (at_m + NEAR_M, at_m + FAR_M)
        inside = (plants > view[0]) & (plants < view[1])
        end.lead(plants[inside], weights[inside], view)
        judged.append((float(at_m), end.judge()))
    return judged


def sure_after_m(judged: list[tuple[float, LaneEndView]], sure: float = SURE) -> float | None:
    """How much was seen empty when the end was first sure."""
    return next((view.empty_m for _, view in judged if view.probability >= sure), None)


def needed_m(crop: CropProfile) -> float:
    """How much must be seen empty until an end is sure."""
    needed = sure_after_m(drive(LaneEnd(crop, -1.0, None), lane(crop, 6.0), 12.0))
    assert needed
    return needed


def with_gap(crop: CropProfile, longest_gap_m: float) -> CropProfile:
    longest = crop.row_end.model_copy(update={"longest_gap_m": longest_gap_m})
    return crop.model_copy(update={"row_end": longest})


@pytest.fixture(scope="session")
def ends() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    return SimpleNamespace(
        beet=BEET,
        near_m=NEAR_M,
        far_m=FAR_M,
        frame_m=FRAME_M,
        sure=SURE,
        rows=rows,
        lane=lane,
        outside=outside,
        drive=drive,
        sure_after_m=sure_after_m,
        needed_m=needed_m,
        with_gap=with_gap,
    )
