"""Rows found in photographs near the robot's own view: F1, angles, positions, beside the paper's finder.

Only rows of at least LEAST_CONFIDENCE count; the reliability of confidence judges all of them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fieldnav.evaluation.benchmark import Better, Figure, Progress, one_by_one
from fieldnav.evaluation.found_rows import UNMATCHED, Finder, FoundRows, with_method
from fieldnav.evaluation.near_nadir_score import Tally, judge, score, total
from fieldnav.evaluation.near_nadir_truth import Photograph, photographs_in
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.reliability import JudgedRows
from fieldnav.messages import Floats, Image
from fieldnav.settings.crop import CropProfile, RowFinder
from fieldnav.settings.loading import Kind, load_crop, names_of

PART = PhotographSet.NEAR_NADIR.title
ALL = "near view, all"
ALIKE_DEG = 2.0
PER_CENT = 100.0
NETWORK = "a network (YOLOv5n-seg, 4 MB), 17 other photographs of the kind"
F1 = Figure(ALL, "F1", float("nan"), goal=0.97, best_known=0.928, source=NETWORK)
ANGLE = Figure(
    ALL, "matched rows within 2 degrees (%)", float("nan"), goal=95.0, best_known=81.7, source=NETWORK
)
POSITION = Figure(
    ALL,
    "mean position error (% of width)",
    float("nan"),
    goal=0.5,
    best_known=0.70,
    source=NETWORK,
    better=Better.LOWER,
)
"""The figures without their values: the goals, and what is known of others."""


@dataclass(frozen=True, slots=True)
class _Scored:
    """One photograph's tallies with fieldnav's finder and with the paper's, and all rows judged.

    paper: None for a crop without a profile, since the moving variance needs one.
    """

    crop: str
    ours: Tally
    paper: Tally | None
    judged: JudgedRows

    @property
    def case(self) -> str:
        return f"near view, {self.crop}{'' if self.paper is not None else ' (no crop profile)'}"


def near_nadir(folder: Path, find: Finder, progress: Progress) -> tuple[list[Figure], JudgedRows]:
    """The figures of this set, and every row found with whether it is right. Raises SettingsError."""
    scored = [_scored(photograph, find) for photograph in one_by_one(PART, photographs_in(folder), progress)]
    return _figures(scored), JudgedRows.joined(each.judged for each in scored)


def _scored(photograph: Photograph, find: Finder) -> _Scored:
    image = read_photograph(photograph.path)
    crop = profile_of(photograph.crop)
    found = find(image, crop)
    paper = None
    if crop is not None:
        paper = _tally(find(image, with_method(crop, RowFinder.MOVING_VARIANCE)), photograph, image)
    ours, judged = _tally(found, photograph, image), _judged(found, photograph, image)
    return _Scored(photograph.crop, ours, paper, judged)


def profile_of(crop: str) -> CropProfile | None:
    """The shipped profile of a crop given in words, its stage in brackets aside; None where there is none."""
    name = "-".join(crop.partition("(")[0].lower().split())
    return load_crop(name) if name in names_of(Kind.CROP) else None


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
    cases = dict.fromkeys(each.case for each in scored)
    crops = {case: [each for each in scored if each.case == case] for case in cases}
    figures += [
        Figure(case, "F1", total(each.ours for each in of_crop).f1) for case, of_crop in crops.items()
    ]
    return figures + _of_paper({ALL: scored} | crops)


def _of_paper(cases: Mapping[str, Sequence[_Scored]]) -> list[Figure]:
    """The paper's finder, of the photographs whose crop has a profile; a case that lacks some says so."""
    figures = []
    for case, scored in cases.items():
        tallies = [each.paper for each in scored if each.paper is not None]
        which = case if len(tallies) == len(scored) else f"{case} with a crop profile"
        if tallies:
            figures.append(Figure(f"{which} (moving variance)", "F1", total(tallies).f1))
    return figures


def _mean(values: Floats | NDArray[np.bool_]) -> float:
    """The mean, NaN of nothing."""
    return float(values.mean()) if len(values) else float("nan")
