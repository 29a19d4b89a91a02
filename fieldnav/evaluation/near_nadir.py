"""Rows found in photographs near the robot's own view: F1, angles, positions, beside the paper's finder.

Only rows of at least LEAST_CONFIDENCE count; the reliability of confidence judges all of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fieldnav.evaluation.benchmark import Better, Figure, Progress
from fieldnav.evaluation.found_rows import UNMATCHED, Finder, FoundRows
from fieldnav.evaluation.near_nadir_score import Tally, judge, score, total
from fieldnav.evaluation.near_nadir_truth import Photograph, PhotographedCrop, photographs_in
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.reliability import JudgedRows
from fieldnav.messages import Floats, Image
from fieldnav.settings.crop import CropProfile, RowFinder
from fieldnav.settings.loading import load_crop

PART = PhotographSet.NEAR_NADIR.title
ALL = "near view, all"
PROFILES = {
    PhotographedCrop.MAIZE: "maize",
    PhotographedCrop.EARLY_MAIZE: "maize",
    PhotographedCrop.SOYBEAN: "soybean",
    PhotographedCrop.WINTER_WHEAT: "winter-wheat",
}
ALIKE_DEG = 2.0
PER_CENT = 100.0
REFERENCE = "reference implementation, same photographs"
F1 = Figure(ALL, "F1", float("nan"), goal=0.95, best_known=0.54, source=REFERENCE)
ANGLE = Figure(
    ALL, "matched rows within 2 degrees (%)", float("nan"), goal=95.0, best_known=46.0, source=REFERENCE
)
POSITION = Figure(
    ALL,
    "mean position error (% of width)",
    float("nan"),
    goal=0.8,
    best_known=2.35,
    source=REFERENCE,
    better=Better.LOWER,
)
"""The figures without their values: the goals, and what is known of others."""


@dataclass(frozen=True, slots=True)
class _Scored:
    """One photograph's tallies with fieldnav's finder and with the paper's, and all rows judged."""

    crop: PhotographedCrop
    ours: Tally
    paper: Tally
    judged: JudgedRows


def near_nadir(folder: Path, find: Finder, progress: Progress) -> tuple[list[Figure], JudgedRows]:
    """The figures of this set, and every row found with whether it is right. Raises SettingsError."""
    photographs = photographs_in(folder)
    scored = []
    for number, photograph in enumerate(photographs):
        progress(PART, number, len(photographs))
        scored.append(_scored(photograph, find))
    progress(PART, len(photographs), len(photographs))
    return _figures(scored), JudgedRows.joined(each.judged for each in scored)


def _scored(photograph: Photograph, find: Finder) -> _Scored:
    image = read_photograph(photograph.path)
    crop = load_crop(PROFILES[photograph.crop])
    found = find(image, crop)
    return _Scored(
        photograph.crop,
        _tally(found, photograph, image),
        _tally(find(image, _as_the_paper(crop)), photograph, image),
        _judged(found, photograph, image),
    )


def _as_the_paper(crop: CropProfile) -> CropProfile:
    """The same crop, its rows found by the moving variance."""
    finding = crop.finding.model_copy(update={"method": RowFinder.MOVING_VARIANCE})
    return crop.model_copy(update={"finding": finding})


def _tally(found: FoundRows, photograph: Photograph, image: Image) -> Tally:
    return score(found.sure().lines, photograph.rows, photograph.must_be_found, _size(image))


def _judged(found: FoundRows, photograph: Photograph, image: Image) -> JudgedRows:
    judged = judge(found.lines, photograph.rows, photograph.must_be_found, _size(image))
    return JudgedRows(found.confidence[judged.counts], judged.true[judged.counts] != UNMATCHED)


def _size(image: Image) -> tuple[int, int]:
    return image.shape[1], image.shape[0]


def _figures(scored: Sequence[_Scored]) -> list[Figure]:
    ours = total(each.ours for each in scored)
    error = ours.distance * PER_CENT
    figures = [
        replace(F1, value=ours.f1),
        replace(ANGLE, value=_mean(ours.turned_deg <= ALIKE_DEG) * PER_CENT),
    ]
    figures.append(replace(POSITION, value=_mean(error), std=float(error.std()) if len(error) else None))
    crops = {
        f"near view, {crop.value}": [each for each in scored if each.crop is crop]
        for crop in PhotographedCrop
    }
    crops = {case: of_crop for case, of_crop in crops.items() if of_crop}
    figures += [
        Figure(case, "F1", total(each.ours for each in of_crop).f1) for case, of_crop in crops.items()
    ]
    return figures + [_of_paper(case, each) for case, each in [(ALL, scored), *crops.items()]]


def _of_paper(case: str, scored: Sequence[_Scored]) -> Figure:
    return Figure(f"{case} (moving variance)", "F1", total(each.paper for each in scored).f1)


def _mean(values: Floats | NDArray[np.bool_]) -> float:
    """The mean, NaN of nothing."""
    return float(values.mean()) if len(values) else float("nan")
